"""Which sites may show the explorer in a frame of their own pages."""

import re
from collections.abc import Sequence

from stackbounce.errors import InvalidValue, shown

_LABEL = r"[a-z0-9_]([a-z0-9_-]*[a-z0-9_])?"
_ORIGIN = re.compile(rf"https?://{_LABEL}(\.{_LABEL})*(:\d{{1,5}})?|\*", re.ASCII)


def read_origin(text: str) -> str:
    """Return an origin in lower case: scheme, host and perhaps port, or ``*`` for all sites.

    Raises
    ------
    InvalidValue
        If the text is anything else.

    Examples
    --------
    >>> read_origin("https://Moodle.School.example")
    'https://moodle.school.example'
    """
    origin = text.lower()
    if not _ORIGIN.fullmatch(origin):
        raise InvalidValue(
            "--embed must be the origin of a site, such as https://moodle.school.example or "
            f"http://localhost:8888, without a path, or * for all sites, got {shown(text)}"
        )
    return origin


def frame_rule(origins: Sequence[str]) -> str:
    """Return the part of a content security policy that says who may frame a page.

    Examples
    --------
    >>> frame_rule([])
    "frame-ancestors 'none'"
    >>> frame_rule(["https://moodle.school.example"])
    'frame-ancestors https://moodle.school.example'
    """
    return " ".join(["frame-ancestors", *(dict.fromkeys(origins) or ["'none'"])])
