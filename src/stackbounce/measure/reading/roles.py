"""The header "Run 1: Time (ms)" -> name, unit and run, and what a column is: a time, a force."""

import re
from dataclasses import dataclass, replace

from stackbounce.files import shipped_table
from stackbounce.units import in_si

_BEFORE = re.compile(r"(Latest|(?:Run|Data Set|Durchgang|Lauf)\b[^:]{0,40}|[^:(\[]{1,40}):\s*(.+)")
_AFTER = re.compile(r"(.+?)[\s,]+((?:Run|Durchgang|Lauf|Ensayo|Essai)\s+#?\d{1,6})")
_BRACKETS = re.compile(r"(.*?)\s*(?:\(([^()]*(?:\([^()]*\)[^()]*)?)\)|\[([^\[\]]*)\])")
_WORDS = re.compile(r"(.+?)(?:\s*/\s*|,\s*|\s+in\s+|\s+|_)(\S{1,20})")
_UNIT_NAME = re.compile(r"(?i)(sec|seconds?|volts?|newtons?|met(?:er|re)s?)(?: ?\d{1,2})?")
_SURE = re.compile(r"(.+?)(?:\s*/\s*|,\s*|\s+in\s+)(\S{1,20}(?: [^\W\d_]{1,2}[\^⁻-]\S{1,3})?)")
FRAME, PIXEL = "frame", "px"
"""The units of time and of length in a video whose frame rate and scale are not known."""

POINT = "point "
"""Begins the name of a track whose points are in no order, those of any ball in each frame."""

_KNOWN: dict[str, dict[str, list[str]]] = shipped_table(__package__, "roles.toml")
_ROLES = {role: re.compile("|".join(known["words"])) for role, known in _KNOWN.items()}
_ACCELERATION = re.compile(
    r"(?P<before>.*\b)?(acceleration|accelerometer|beschleunigung|accélération|aceleración"
    r"|aceleração|accelerazione|acc\b)(?P<rest>.*)|a(?P<axis>[_ ]?[xyz])?"
)
_BY_UNIT = {"s": "time", "N": "force", "V": "voltage", "m/s^2": "acceleration"}
_PIXELS = re.compile(r"px|pix|pixels?", re.IGNORECASE)
_BETWEEN = re.compile(r"interval|duration|period|delay|dauer|δt|^dt")  # durations, no moments
ARBITRARY = ("a.u.", "a. u.", "arb. units", "arbitrary")
"""Units of numbers that may be anything."""
_FAR = 1e3  # m: positions in such a unit are no heights of a ball
ACCELERATIONS = tuple("acceleration" + axis for axis in ("_x", "_y", "_z", "_absolute", ""))
ROLES = (*_KNOWN, *ACCELERATIONS)
"""What a column can be."""
G = 9.80665


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
    >>> heading("drop height/cm").name, heading("v/(m/s)").name
    ('drop height', 'v')
    """
    text = " ".join(text.lstrip("#%").split())[:200]
    name, run = text.removesuffix(" Auto"), ""  # of times that Capstone counts itself
    if (found := _AFTER.fullmatch(name)) or (found := _BEFORE.fullmatch(name)):
        run, name = (found[1], found[2]) if found.re is _BEFORE else (found[2], found[1])
    if unit is not None:
        return Heading(text, name, unit.strip(" ()[]"), run)
    if found := _BRACKETS.fullmatch(name):
        return Heading(text, found[1].rstrip("/ "), (found[2] or found[3] or "").strip(), run)
    for found in filter(None, (_SURE.fullmatch(name), _WORDS.fullmatch(name))):
        if in_si(found[2], common=not _SURE.fullmatch(name)):
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


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Parameters
    ----------
    index : int
        Where it stands, from 0.
    heading : Heading
        What its header says.
    role : str
        ``time``, ``force``, ``x`` …; empty for anything else.
    factor : float
        Factor from the unit in the file to SI.
    unit : str
        The SI unit; empty where it is unknown.
    track : str
        The name of its track, if a table has several.
    named : str
        The name that the option `names` gives it.
    doubt : str
        What is unsure about it.
    """

    index: int
    heading: Heading
    role: str = ""
    factor: float = 1.0
    unit: str = ""
    track: str = ""
    named: str = ""
    doubt: str = ""

    @property
    def variable(self) -> str:
        """What it is called in the Dataset."""
        return self.named or self.role or slug(self.heading.name or f"column {self.index + 1}")

    def called(self, name: str, unit: str | None) -> "Column":
        """Return the column with another name or unit, by an option of `read`."""
        said = self.heading if unit is None else replace(self.heading, unit=unit)
        role, factor, symbol, doubt = _role(name or self.heading.name, said.unit, self.role)
        if name:
            role = name if name in ROLES else ""
        named = name or self.named
        return Column(self.index, said, role, factor, symbol, self.track, named, doubt)


def column(index: int, said: Heading, role: str = "", track: str = "") -> Column:
    """Return a column by its header; without a given role it is found from name and unit.

    Examples
    --------
    >>> from stackbounce.measure.reading.roles import heading
    >>> force = column(1, heading("Fz (kN) Run #1"))
    >>> force.role, force.factor, force.unit
    ('force', 1000.0, 'N')
    """
    found, factor, symbol, doubt = _role(said.name, said.unit, role)
    return Column(index, said, found, factor, symbol, track, doubt=doubt)


def _role(name: str, unit: str, told: str) -> tuple[str, float, str, str]:
    """Return role, factor to SI, SI unit and a doubt; `told` is a role that is already known."""
    word = " ".join(name.casefold().replace("_", " ").split())
    factor, symbol = (in_si(unit) if unit else None) or (1.0, "")
    doubt = ""
    if _PIXELS.fullmatch(unit):
        symbol = PIXEL
    if unit and not symbol and re.search(r"\w", unit) and unit not in ARBITRARY:
        doubt = f"unit {unit!r} of {name!r} is not known here: its numbers are left as they are"
    bend = _ACCELERATION.fullmatch(word)
    if bend and (symbol in ("m/s^2", "") or unit == "g"):
        factor, symbol = (G, "m/s^2") if unit == "g" else (factor, symbol)
        axis = _axis(bend["rest"] or bend["axis"] or bend["before"] or "")
        return told or axis, factor, symbol, doubt
    if not told and symbol == "m/s^2" and word in ("x", "y", "z"):
        return f"acceleration_{word}", factor, symbol, doubt
    if not told and unit.casefold() in ("frame", "frames"):
        return "frame", 1.0, "", ""
    role = told or next((known for known, words in _ROLES.items() if words.fullmatch(word)), "")
    if symbol and role in _KNOWN and symbol not in _KNOWN[role]["units"]:
        role = ""
    if role == "time" and not unit and "sec" in word:
        symbol = "s"
    if role in ("x", "y") and not told and factor >= _FAR:
        role = ""
    if not role and symbol in _BY_UNIT and not _BETWEEN.search(word):
        role = _BY_UNIT[symbol]
    if role == "force" and symbol == "kg":
        factor, symbol = factor * G, "N"
        doubt = f"{name!r} in {unit} is taken as a weight: times {G} m/s^2"
    if role == "sound" and unit in ("dB", "dBA"):
        role = ""
    return role, factor, symbol, doubt


def _axis(rest: str) -> str:
    rest = rest.strip(" _-")
    if rest in ("x", "y", "z"):
        return f"acceleration_{rest}"
    return "acceleration_absolute" if rest.startswith(("abs", "mag", "betrag")) else "acceleration"
