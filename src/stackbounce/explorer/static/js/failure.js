/** Errors of the page itself: one part that fails leaves the others alive. */

let listener = null;
let isTold = false; // while the listener hears of one

/** Have a listener hear each error that `safely` has caught. */
export function onFailure(hears) {
  listener = hears;
}

/** Call a function; where it fails the browser's console has the error, and the listener hears of it. */
export function safely(act, ...given) {
  try {
    act(...given);
  } catch (error) {
    reportError(error);
    if (isTold) return;
    isTold = true;
    try {
      listener?.(error);
    } finally {
      isTold = false;
    }
  }
}
