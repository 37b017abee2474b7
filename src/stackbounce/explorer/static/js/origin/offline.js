/**
 * The service worker of the explorer as a folder: keeps its files in the browser, and answers from there. Before this text
 * the folder's file has VERSION, a digest of all files, and FILES, the digest of each by its address.
 *
 * A page has files of one version only: a newer one is kept beside the older, and takes its place once no page of the
 * older is open.
 */

const { scope } = registration;
const OURS = `stackbounce ${scope} `; // a server may have several folders, whose caches are together
const NAME = OURS + VERSION;

/** Keep all files, or none if one of them is not of this version. */
async function keep() {
  const cache = await caches.open(NAME);
  await cache.addAll(Object.entries(FILES).map(([address, integrity]) => new Request(address, { integrity, cache: "no-cache" })));
}

/** Forget older versions, and answer pages that were opened before there was a service worker. */
async function takeOver() {
  const older = (await caches.keys()).filter((name) => name.startsWith(OURS) && name !== NAME);
  await Promise.all(older.map((name) => caches.delete(name)));
  await clients.claim();
}

async function answer(request) {
  const address = request.url.split(/[?#]/)[0];
  const cache = await caches.open(NAME);
  return (await cache.match(address === `${scope}index.html` ? scope : address)) ?? fetch(request);
}

addEventListener("install", (event) => event.waitUntil(keep()));
addEventListener("activate", (event) => event.waitUntil(takeOver()));
addEventListener("fetch", (event) => event.respondWith(answer(event.request)));
