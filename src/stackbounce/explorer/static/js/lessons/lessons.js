/** The lessons beside the page: the list of them, or one with its steps, its answers and its worksheet, which can be printed. */

import { button, copyOf, fillFrom, h, tableBox, write } from "../dom.js";
import { embedded } from "../embed.js";
import { t } from "../words/language.js";
import { language } from "../words/language_choice.js";
import { asksFirst } from "../state/address.js";
import { LESSON_LIST } from "../state/store.js";

/** Show the store's lesson in `root`, and let the button open the list; returns what gives the lessons, by language. */
export function mountLessons({ root, button }, store) {
  let lessons = null;
  const open = (lesson) => store.set({ lesson });
  const isOpen = () => store.get().lesson !== null && !embedded;
  const fill = () => {
    const { lesson: name } = store.get();
    if (!lessons || !isOpen()) return;
    const lesson = lessons.find((lesson) => lesson.name === name);
    if (lesson) showLesson(root, lesson, open);
    else showList(root, lessons, open);
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
  store.derive((state, before) => {
    if (state.lesson === before.lesson) return null;
    const asks = asksFirst({ ...state, closer: true });
    return { closer: state.closer || state.lesson !== null, ...(asks || state.lesson === null ? { predict: asks, guess: null } : {}) };
  });
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

/** Fill `root` with what a template has; its texts are in the page's language, which may not be that of the lessons. */
function fillWith(root, template, open) {
  const parts = fillFrom(root, template);
  for (const part of root.querySelectorAll("[data-t], [data-t-label]")) part.lang = language;
  write(parts.close, "×");
  parts.close.addEventListener("click", () => open(null));
  return parts;
}

function minutes(lesson) {
  return h("span", { lang: language, text: t("{count} minutes", { count: lesson.minutes }) });
}

function showList(root, lessons, open) {
  const entry = (lesson) =>
    h(
      "button",
      { type: "button", class: "lesson-choice", "data-key": `lesson-${lesson.name}`, onclick: () => open(lesson.name) },
      h("strong", { text: lesson.title }),
      h("span", { text: lesson.about }),
      h("span", { class: "note" }, `${lesson.for_whom}; `, minutes(lesson)),
    );
  fillWith(root, "lessons-parts", open).list.append(...lessons.map((lesson) => h("li", {}, entry(lesson))));
}

function showLesson(root, lesson, open) {
  const parts = fillWith(root, "lesson-parts", open);
  const say = (text) => told(text, lesson, open);
  for (const name of ["title", "for_whom", "needs", "misconception"]) write(parts[name], lesson[name]);
  for (const name of ["questions", "answers"]) parts[name].append(...lesson[name].map((text) => h("li", {}, say(text))));
  parts.all.addEventListener("click", () => open(LESSON_LIST));
  parts.time.append(minutes(lesson));
  parts.printer.addEventListener("click", printWorksheet);
  parts.steps.append(...lesson.steps.map((step, place) => h("li", {}, stepOf(step, say, place === 0))));
  for (const part of [parts.exampleTitle, parts.example]) part.hidden = !lesson.example;
  parts.example.append(...say(lesson.example ?? []));
  if (lesson.table) parts.teacher.append(tableBox("group", t("Answers for the teacher"), ...lesson.table));
  parts.teacher.append(...lesson.remarks.map((text) => h("p", {}, say(text))));
  write(parts.name, lesson.title);
  parts.worksheet.append(...lesson.worksheet.map(taskOf));
}

/** Return a step, of which only the title is seen until it is opened: a later one tells what an earlier one asks. */
function stepOf(step, say, open) {
  return h("details", { open }, h("summary", {}, h("strong", {}, `${step.title} (`, minutes(step), ")")), h("p", {}, say(step.text)));
}

/** Return the parts of a text: of a link either the page's own address, which sets its state, or another lesson. */
function told(text, lesson, open) {
  return [text].flat().map((part) => {
    if (typeof part === "string") return part;
    if (part.lesson) return button(part.words, () => open(part.lesson), { class: "lesson-link" });
    return h("a", { href: `#${part.fragment}&lesson=${lesson.name}`, text: part.words, onclick: lookThere });
  });
}

/** Bring the view and the head of the page into sight once the link is followed. */
function lookThere() {
  addEventListener("hashchange", () => scrollTo(0, 0), { once: true });
}

function taskOf({ text, table: rows, grid, after }) {
  return h("li", {}, text, rows ? tableBox("group", text, ...rows) : null, grid ? copyOf("empty-grid") : null, after ? h("p", { text: after }) : null);
}

/** Print the worksheet and nothing else. */
function printWorksheet() {
  document.body.classList.add("only-worksheet");
  addEventListener("afterprint", () => document.body.classList.remove("only-worksheet"), { once: true });
  print();
}
