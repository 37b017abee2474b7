/** The form of a line or a map: built anew where its settings, or the choices that there are, have changed. */

/**
 * Return what fills the form in an element with news.
 * @param {object} kind `name` of the view, `extra(news)`, what it shows besides settings and numbers, and
 * `fill(news, {current, change})`, which returns its parts @param {(settings: object) => void} set hears other settings
 */
export function drawingForm(element, { name, extra, fill }, set) {
  element.addEventListener("submit", (event) => event.preventDefault());
  let shown = "";
  const update = (news) => {
    const { settings, paths } = news;
    const now = JSON.stringify([settings, paths.map(({ path, label: words }) => [path, words]), extra(news)]);
    if (now === shown) return;
    shown = now;
    const focused = document.activeElement?.dataset?.key;
    let latest = settings; // a second choice may come before the first one is answered
    const change = (patch) => {
      const before = latest;
      set((latest = { ...latest, ...patch }));
      if (["x", "y"].some((side) => latest[side]?.path !== before[side]?.path)) update({ ...news, answer: null, settings: latest }); // its ends are of another unit
    };
    element.replaceChildren(...fill(news, { current: () => latest, change }));
    if (focused?.startsWith(`${name}-`)) element.querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  };
  return patient(element, update);
}

/** Return a function that updates a form, but not while somebody types into it: what is typed would be lost. */
function patient(form, update) {
  let late = null;
  form.addEventListener("change", () => (late = null)); // what was typed is taken, and brings news of its own
  form.addEventListener("focusout", () => late && update(late));
  return (news) => {
    const typing = [...form.querySelectorAll("input[type=text]")].some((input) => input === document.activeElement && input.value !== input.defaultValue);
    late = typing ? news : null;
    if (!typing) update(news);
  };
}
