"""The lessons for the page: their texts with links that the page can follow."""

from typing import Any

from stackbounce.explorer.lessons import (
    LANGUAGES,
    NAMES,
    Link,
    explorer_fragment,
    read_lesson,
    split_links,
)
from stackbounce.json_values import plain


def list_lessons() -> dict[str, list[dict[str, Any]]]:
    """Return the lessons by language. A text with links is the list of its parts.

    A link is an object with its `words` and the `fragment` of the page's address, or a `lesson`.

    Examples
    --------
    >>> lessons = list_lessons()
    >>> lessons["en"][0]["title"], lessons["en"][0]["minutes"]
    ('Three times the speed?', 45)
    """
    return {
        language: [_told(plain(read_lesson(name, language))) for name in NAMES]
        for language in LANGUAGES
    }


def _told(value: Any) -> Any:
    """Return a lesson, or a part of it, with its links taken out of its texts."""
    if isinstance(value, dict):
        return {key: _told(one) for key, one in value.items() if one not in ("", [], False)}
    if isinstance(value, list):
        return [_told(item) for item in value]
    parts = split_links(value) if isinstance(value, str) else []
    return (
        [_link(part) for part in parts] if any(isinstance(part, Link) for part in parts) else value
    )


def _link(part: str | Link) -> str | dict[str, str]:
    if isinstance(part, str):
        return part
    if part.to == "lesson":
        return {"words": part.words, "lesson": part.what}
    return {"words": part.words, "fragment": explorer_fragment(part.what)}
