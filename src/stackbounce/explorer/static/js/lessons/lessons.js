/** The lessons beside the page: the list of them, or one with its steps, its answers and its worksheet, which can be printed. */

import { button, h, s } from "../dom.js";
import { embedded } from "../embed.js";
import { t } from "../words/language.js";
import { language } from "../words/language_choice.js";
import { LESSON_LIST } from "../state/store.js";

const GRID = { width: 160, height: 90, step: 10 }; // of squares to draw in

/** Show the store's lesson in `root`, and let the button open the list; returns what gives the lessons, by language. */
export function mountLessons({ root, button }, store) {
  let lessons = null;
  const open = (lesson) => store.set({ lesson });
  const isOpen = () => store.get().lesson !== null && !embedded;
  const fill = () => {
    const { lesson: name } = store.get();
    if (!lessons || !isOpen()) return;
    const lesson = lessons.find((lesson) => lesson.name === name);
    root.replaceChildren(...(lesson ? lessonParts(lesson, open) : listParts(lessons, open)));
    root.scrollTop = 0;
  };
  const show = () => {
    document.body.classList.toggle("with-lesson", isOpen());
    root.hidden = !isOpen();
    button.setAttribute("aria-expanded", String(isOpen()));
    fill();
  };
  button.addEventListener("click", () => open(isOpen() ? null : LESSON_LIST));
  root.addEventListener("keydown", ({ key }) => key === "Escape" && open(null));
  store.watch(["lesson"], () => {
    const focused = root.contains(document.activeElement);
    show();
    if (isOpen()) root.querySelector("h2")?.focus();
    else if (focused) button.focus();
  });
  show();
  return (byLanguage) => {
    lessons = byLanguage[language] ?? byLanguage.en;
    if (lessons === byLanguage.en) root.lang = "en";
    fill();
  };
}

function head(first, open) {
  const close = own("button", "×", { type: "button", class: "icon", "aria-label": t("Close the lessons"), onclick: () => open(null) });
  return h("div", { class: "lesson-head" }, first, close);
}

/** Return an element with a text in the page's language, which may not be that of the lessons. */
function own(tag, text, attributes = {}) {
  return h(tag, { lang: language, text, ...attributes });
}

function minutes(lesson) {
  return t("{count} minutes", { count: lesson.minutes });
}

function listParts(lessons, open) {
  const entry = (lesson) =>
    h(
      "button",
      { type: "button", class: "lesson-choice", "data-key": `lesson-${lesson.name}`, onclick: () => open(lesson.name) },
      h("strong", { text: lesson.title }),
      h("span", { text: lesson.about }),
      h("span", { class: "note" }, `${lesson.for_whom}; `, own("span", minutes(lesson))),
    );
  const says = t("Each has steps that set this page, questions, answers for the teacher, and a worksheet to print.");
  const title = own("h2", t("Lessons"), { tabindex: -1 });
  return [head(title, open), own("p", says, { class: "note" }), h("ul", { class: "lesson-list" }, lessons.map((lesson) => h("li", {}, entry(lesson))))];
}

function lessonParts(lesson, open) {
  const texts = (list) => h("ol", {}, list.map((text) => h("li", {}, told(text, lesson, open))));
  const fact = (name, ...value) => h("div", {}, own("dt", name), h("dd", {}, ...value));
  const answers = h(
    "details",
    { class: "lesson-answers" },
    own("summary", t("Answers for the teacher")),
    texts(lesson.answers),
    lesson.table ? table(lesson.table, t("Answers for the teacher")) : null,
    lesson.remarks.map((text) => h("p", {}, told(text, lesson, open))),
  );
  const all = own("button", t("All lessons"), { type: "button", class: "small", onclick: () => open(LESSON_LIST) });
  return [
    head(all, open),
    h("h2", { tabindex: -1, text: lesson.title }),
    h(
      "dl",
      { class: "lesson-facts" },
      fact(t("For whom"), lesson.for_whom),
      fact(t("Time"), own("span", minutes(lesson))),
      fact(t("Needs"), lesson.needs),
      fact(t("Misconception"), lesson.misconception),
    ),
    own("button", t("Print the worksheet"), { type: "button", onclick: printWorksheet }),
    own("h3", t("Steps")),
    h("ol", {}, lesson.steps.map((step) => stepOf(step, lesson, open))),
    ...(lesson.example ? [own("h3", t("An example")), h("p", {}, told(lesson.example, lesson, open))] : []),
    own("h3", t("Questions")),
    texts(lesson.questions),
    answers,
    own("h3", t("Worksheet")),
    worksheet(lesson),
  ];
}

function stepOf(step, lesson, open) {
  const title = h("strong", {}, `${step.title} (`, own("span", minutes(step)), "). ");
  return h("li", {}, title, told(step.text, lesson, open));
}

/** Return the parts of a text: of a link either the page's own address, which sets its state, or another lesson. */
function told(text, lesson, open) {
  return [text].flat().map((part) => {
    if (typeof part === "string") return part;
    if (part.lesson) return button(part.words, () => open(part.lesson), { class: "lesson-link" });
    return h("a", { href: `#${part.fragment}&lesson=${lesson.name}`, text: part.words, onclick: lookThere });
  });
}

/** Bring the view into sight once the link is followed. */
function lookThere() {
  addEventListener("hashchange", () => document.querySelector("main > [role=tabpanel]:not([hidden])").scrollIntoView(), { once: true });
}

/** Return a table in a box that scrolls, which a label names; the cells that a row lacks are empty. */
function table([heads, ...rows], label) {
  const cells = (row) => heads.map((_, i) => (i === 0 && row[0] ? h("th", { scope: "row", text: row[0] }) : h("td", { text: row[i] ?? "" })));
  const top = heads.map((text) => (text ? h("th", { scope: "col", text }) : h("td")));
  const inside = h("table", {}, h("thead", {}, h("tr", {}, top)), h("tbody", {}, rows.map((row) => h("tr", {}, cells(row)))));
  return h("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": label }, inside);
}

function worksheet(lesson) {
  const item = ({ text, table: rows, grid, after }) =>
    h("li", {}, text, rows ? table(rows, text) : null, grid ? emptyGrid() : null, after ? h("p", { text: after }) : null);
  return h(
    "div",
    { class: "worksheet" },
    h("p", {}, h("strong", { text: lesson.title }), " ", own("span", t("Name: ______________________ Date: ______________"))),
    h("ol", {}, lesson.worksheet.map(item)),
  );
}

function emptyGrid() {
  const { width, height, step } = GRID;
  let lines = "";
  for (let x = step; x <= width; x += step) lines += `M${x} 0V${height}`;
  for (let y = 0; y < height; y += step) lines += `M0 ${y}H${width}`;
  const svg = s("svg", { class: "worksheet-grid", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": t("An empty grid") });
  svg.append(s("path", { class: "thin", d: lines }), s("path", { d: `M0 0V${height}H${width}` }));
  return svg;
}

/** Print the worksheet and nothing else. */
function printWorksheet() {
  document.body.classList.add("only-worksheet");
  addEventListener("afterprint", () => document.body.classList.remove("only-worksheet"), { once: true });
  print();
}
