"""Sphinx extension: the lessons of `page_build.lessons`, which the explorer shows, too.

On a page, a block ``{lesson} NAME`` stands for a whole lesson, and a block ``{lessons}`` for the
table of all. They are replaced before Sphinx reads the page, as a lesson has sections.
"""

import re
from collections.abc import Iterator
from typing import Any

from page_build.lessons.lesson import NAMES, read_lesson, split_links
from sphinx.application import Sphinx

_LINE = "______________________"
_WIDTH, _HEIGHT, _STEP = 160, 90, 10
_LINES = "".join(
    [f"M{x} 0V{_HEIGHT}" for x in range(_STEP, _WIDTH + 1, _STEP)]
    + [f"M0 {y}H{_WIDTH}" for y in range(0, _HEIGHT, _STEP)]
)
_GRID = f"""\
```{{raw}} html
<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="An empty grid" class="grid">
  <path class="thin" d="{_LINES}"/>
  <path d="M0 0V{_HEIGHT}H{_WIDTH}"/>
</svg>
```"""


_BLOCK = re.compile(r"^```\{(lessons?)\} ?(.*)\n```$", re.MULTILINE)


def setup(app: Sphinx) -> dict[str, Any]:
    """Replace the blocks."""
    app.connect("source-read", _replace)
    return {"version": "1", "parallel_read_safe": True}


def _replace(_app: Sphinx, _page: str, source: list[str]) -> None:
    source[0] = _BLOCK.sub(_written, source[0])


def _written(block: re.Match[str]) -> str:
    return lesson_markdown(read_lesson(block[2])) if block[1] == "lesson" else _list_markdown()


def _list_markdown() -> str:
    rows = [["lesson", "for whom", "time", "what it is about"]]
    for lesson in map(read_lesson, NAMES):
        title = f"[{lesson['title']}]({lesson['name']}.md)"
        rows.append([title, lesson["for_whom"], f"{lesson['minutes']} minutes", lesson["about"]])
    return _table(rows)


def lesson_markdown(lesson: dict[str, Any]) -> str:
    """Return a lesson as the documentation has it."""
    return "\n\n".join(_blocks(lesson)) + "\n"


def _blocks(lesson: dict[str, Any]) -> Iterator[str]:
    yield f"For whom\n: {lesson['for_whom']}"
    yield f"Time\n: {lesson['minutes']} minutes"
    yield f"Needs\n: {lesson['needs']}"
    yield f"Misconception\n: {lesson['misconception']}"
    yield "## Steps"
    yield _listed(
        [
            f"**{step['title']} ({step['minutes']} minutes).** {step['text']}"
            for step in lesson["steps"]
        ]
    )
    if "example" in lesson:
        yield f"## An example\n\n{_linked(lesson['example'])}"
    yield f"## Questions\n\n{_listed(lesson['questions'])}"
    yield f"## Answers for the teacher\n\n{_listed(lesson['answers'])}"
    if "table" in lesson:
        yield _table(lesson["table"])
    yield from map(_linked, lesson["remarks"])
    yield "## Worksheet"
    yield "````{container} worksheet"
    yield f"**{lesson['title']}** Name: {_LINE} Date: ______________"
    for i, item in enumerate(lesson["worksheet"], 1):
        yield from _item(i, item)
    yield "````"


def _item(number: int, item: dict[str, Any]) -> Iterator[str]:
    yield f"{number}. {item['text']}"
    if "table" in item:
        yield _table(item["table"])
    if "grid" in item:
        yield _GRID
    if "after" in item:
        yield item["after"]


def _listed(texts: list[str]) -> str:
    return "\n".join(f"{i}. {_linked(text)}" for i, text in enumerate(texts, 1))


def _linked(text: str) -> str:
    """Return a text with its links as Markdown has them."""
    return "".join(
        part
        if isinstance(part, str)
        else f"[{part.words}]({part.what}.md)"
        if part.to == "lesson"
        else f"{{explorer}}`{part.words} <{part.what}>`"
        for part in split_links(text)
    )


def _table(rows: list[list[str]]) -> str:
    width = max(map(len, rows))
    lines = [[*row, *[""] * (width - len(row))] for row in rows]
    lines.insert(1, ["---"] * width)
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
