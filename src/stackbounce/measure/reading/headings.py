"""What the header of a column says: "Run 1: Time (ms)" -> name, unit, run."""

import re
from dataclasses import dataclass

from stackbounce.units import in_si

_BEFORE = re.compile(r"(Latest|(?:Run|Data Set|Durchgang|Lauf)\b[^:]{0,40}|[^:(\[]{1,40}):\s*(.+)")
_AFTER = re.compile(r"(.+?)[\s,]+((?:Run|Durchgang|Lauf|Ensayo|Essai)\s+#?\d{1,6})")
_BRACKETS = re.compile(r"(.*?)\s*(?:\(([^()]*(?:\([^()]*\)[^()]*)?)\)|\[([^\[\]]*)\])")
_WORDS = re.compile(r"(.+?)(?:\s*/\s*|,\s*|\s+in\s+|\s+|_)(\S{1,20})")
_UNIT_NAME = re.compile(
    r"(sec|seconds?|volts?|newtons?|met(?:er|re)s?)(?: ?\d{1,2})?", re.IGNORECASE
)
_SURE = re.compile(r".+?(?:\s*/\s*|,\s*|\s+in\s+)\S{1,20}")


@dataclass(frozen=True)
class Heading:
    """What the header of a column says.

    Parameters
    ----------
    text : str
        As it stands in the file.
    name : str
        Without run and unit.
    unit : str
        As it is written; empty where there is none.
    run : str
        The run that it belongs to; empty if the header names none.
    """

    text: str
    name: str
    unit: str = ""
    run: str = ""


def heading(text: str, unit: str | None = None) -> Heading:
    """Return what a header says.

    Parameters
    ----------
    text : str
        The header's cell.
    unit : str, optional
        The unit, where another line of the file has it.

    Examples
    --------
    >>> heading("Run 1: Time (ms)")
    Heading(text='Run 1: Time (ms)', name='Time', unit='ms', run='Run 1')
    >>> heading("Force / N").unit, heading("force_N").unit, heading("Volt1").unit
    ('N', 'N', 'volt')
    """
    text = " ".join(text.lstrip("#%").split())[:200]
    name, run = text, ""
    if (found := _AFTER.fullmatch(name)) or (found := _BEFORE.fullmatch(name)):
        before = found.re is _BEFORE
        run, name = (found[1], found[2]) if before else (found[2], found[1])
    if unit is not None:
        return Heading(text, name, unit.strip(" ()[]"), run)
    if found := _BRACKETS.fullmatch(name):
        return Heading(text, found[1], (found[2] or found[3] or "").strip(), run)
    if (found := _WORDS.fullmatch(name)) and in_si(found[2], common=not _SURE.fullmatch(name)):
        return Heading(text, found[1], found[2], run)
    if found := _UNIT_NAME.fullmatch(name):
        return Heading(text, name, found[1].casefold(), run)
    return Heading(text, name, "", run)


def is_unit(cell: str) -> bool:
    """Return whether a cell is a unit alone, such as ``(ms)`` or ``Volt``."""
    bare = cell.strip()
    if re.fullmatch(r"\(.*\)|\[.*\]", bare):
        return True
    return in_si(bare, common=len(bare) < 3) is not None


def slug(name: str) -> str:
    """Return a name as the name of a variable.

    Examples
    --------
    >>> slug("Sound pressure level")
    'sound_pressure_level'
    """
    word = re.sub(r"\W+", "_", name.casefold(), flags=re.ASCII).strip("_")
    return word if word and not word[0].isdigit() else f"column_{word}".rstrip("_")
