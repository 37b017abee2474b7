"""The kinds of measurement: a folder for each, with its analysis, its result and its `Kind`."""

from stackbounce.measure.kind import Kind
from stackbounce.measure.kinds.acceleration import ACCELERATION
from stackbounce.measure.kinds.bounces import KNOCKS
from stackbounce.measure.kinds.contact import CONTACT
from stackbounce.measure.kinds.heights import TABLE
from stackbounce.measure.kinds.press import PRESS
from stackbounce.measure.kinds.sound import SOUND
from stackbounce.measure.kinds.track import TRACK
from stackbounce.measure.kinds.waveform import WAVEFORM

__all__ = ["KINDS", "TYPED", "Kind", "kind_named"]

KINDS: dict[str, Kind] = {
    kind.name: kind for kind in (KNOCKS, PRESS, WAVEFORM, SOUND, TRACK, ACCELERATION, TABLE)
}
"""What a file can hold; the first one that a file's columns fit is what it holds."""

TYPED: tuple[Kind, ...] = (TABLE, CONTACT)
"""What numbers without a file can tell."""


def kind_named(text: str) -> str | None:
    """Return the name of a kind of files, which may be typed in other ways; None for no kind.

    Examples
    --------
    >>> kind_named("press-curve"), kind_named("Press"), kind_named("sounds")
    ('press curve', 'press curve', None)
    """
    typed = " ".join(text.casefold().replace("-", " ").replace("_", " ").split())
    return next((name for name in KINDS if typed in (name, name.split()[0])), None)
