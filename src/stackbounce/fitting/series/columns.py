"""Which column of a table of bounces holds what, by its heading."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from stackbounce.errors import InvalidValue
from stackbounce.files import shipped_table
from stackbounce.measure.reading.roles import heading
from stackbounce.model.catalogue import ENTRIES
from stackbounce.units import in_si

_KNOWN = shipped_table(__package__, "columns.toml")
WORDS = {of: re.compile(pattern) for of, pattern in _KNOWN.pop("words").items()}
"""What names of columns, and cells, tell besides the role of a column, each a pattern."""

_ROLES = {role: re.compile(known["words"]) for role, known in _KNOWN.items()}

UNITS: dict[str, str] = {role: known["unit"] for role, known in _KNOWN.items()}
"""The SI unit of each role."""

_NUMBERED = re.compile(
    r"(.*?[^\d\s_.#])[\s_.#]*\(?(\d{1,2})\)?|(\d{1,2})(?:st|nd|rd|th|e|er|\.|º|ª) (.*)"
)
_READING = re.compile(rf"(.* )?({_KNOWN['reading']['words']})")
_TOLD = re.compile(r"\s*\(?\s*(?:±|\+/-)\s*([\d.,]*\d)\s*([^\W\d_]*)\s*\)?")


@dataclass(frozen=True)
class Column:
    """A column of a table of bounces.

    Parameters
    ----------
    index : int
        Where it stands, from 0.
    text : str
        Its heading.
    role : str
        A key of `UNITS`, ``"bounces"`` for the height after bounce `number`, ``"readings"`` for the
        reading `number` of the same height, ``"error"``, or empty if it is not known.
    unit : str
        As it is written in the heading; empty where there is none.
    number : int
        Of a bounce or of a reading; of an error: the index of the column that has it.
    error : str
        The error of all its numbers, as ``± 0.5 cm`` in the heading tells it; empty for none.
    ball : str
        The ball of the catalogue that its heading names; empty if it names none.
    mean : bool
        Whether its heading says that it holds means.
    """

    index: int
    text: str
    role: str = ""
    unit: str = ""
    number: int = 0
    error: str = ""
    ball: str = ""
    mean: bool = False


def columns_of(headings: list[str]) -> list[Column]:
    """Return what the columns of a table hold.

    Parameters
    ----------
    headings : list of str
        The cells of its first row.

    Examples
    --------
    >>> [column.role for column in columns_of(["ball", "Fallhöhe (cm)", "Sprunghöhe (cm)", "± cm"])]
    ['group', 'drop_height', 'rebound_height', 'error']
    """
    found: list[Column] = []
    for index, text in enumerate(" ".join(text.replace("_", " ").split()) for text in headings):
        error = _TOLD.search(text)
        told = f"{error[1]} {error[2]}".strip() if error else ""
        rest = f"{text[: error.start()]} {text[error.end() :]}".strip() if error else text
        if (not error and WORDS["errors"].search(text.casefold())) or (error and not rest):
            found.append(_error(index, text, found))
            continue
        said = heading(f"{rest})" if rest.count("(") > rest.count(")") else rest)
        name, unit = said.name.casefold(), said.unit or (error[2] if error else "")
        bare = WORDS["mean"].sub("", name)
        role, number = _role(bare, unit) if bare or index else ("reading", 0)
        ball = "" if role else _ball(bare)
        if ball:
            role = "rebound_ratio" if WORDS["ratio"].search(bare) else "rebound_height"
        found.append(Column(index, text, role, unit, number, told, ball, bare != name))
    return found


def check_balls(columns: Sequence[Column]) -> None:
    """Refuse a column of lengths beside one of a ball if it names none itself."""
    beside = next((column.text for column in columns if column.ball), "")
    for column in columns:
        known = in_si(column.unit) if beside and column.unit and not column.role else None
        if known and known[1] == "m":
            raise InvalidValue(
                f"column {column.text!r} must name a ball of the catalogue, as {beside!r} beside "
                "it does"
            )


def _ball(name: str) -> str:
    """Return the ball of the catalogue that a name begins with; empty if there is none."""
    plain = name.replace("-", " ")
    named = (ball for ball in ENTRIES if re.match(rf"{re.escape(ball.casefold())}\b", plain))
    return max(named, key=len, default="")


def role_of(name: str) -> str:
    """Return what a name of a column means; empty if it means nothing known here.

    Examples
    --------
    >>> role_of("drop height"), role_of("temperature")
    ('drop_height', '')
    """
    return _role(" ".join(name.casefold().replace("_", " ").split()), "")[0]


def _role(name: str, unit: str) -> tuple[str, int]:
    """Return what a name means, and the number of a bounce or a reading in it."""
    known = in_si(unit) if unit else None
    for role, words in _ROLES.items():
        fits = not known or known[1] in (UNITS[role], "1" if not UNITS[role] else UNITS[role])
        if words.fullmatch(name) and fits:
            return role, 0
    if numbered := _NUMBERED.fullmatch(name):
        word, number = (numbered[1], numbered[2]) if numbered[1] else (numbered[4], numbered[3])
        if WORDS["bounce"].fullmatch(word.strip()):
            return "bounces", int(number)
        if _READING.fullmatch(word.strip()):
            return "readings", int(number)
    return "", 0


def _error(index: int, text: str, before: list[Column]) -> Column:
    """Return a column of errors: of the one that its name tells, or of the one to its left."""
    if WORDS["twice"].search(text.casefold()):
        raise InvalidValue(f"column {text!r} has two standard deviations: give one, as 'error'")
    said = heading(text)
    whole = WORDS["errors"].sub(" ", said.name.casefold())
    bare = " ".join(WORDS["filler"].sub(" ", whole).split())
    whose = next((c.index for c in reversed(before) if bare and _same(bare, c)), None)
    if whose is None:
        left = (c.index for c in reversed(before) if c.mean or c.role not in ("", "error"))
        whose = next(left, -1)
    if said.unit == "%" and not any(c.index == whose and c.unit == "%" for c in before):
        raise InvalidValue(f"column {text!r} must have errors in the unit of what they belong to")
    return Column(index, text, "error", said.unit, whose)


def _same(bare: str, column: Column) -> bool:
    """Return whether what is left of the name of an error is the name of a column, or means it."""
    name = heading(column.text).name.casefold()
    return bare in (name, name.split()[0]) or (
        _role(bare, "") == (column.role, column.number) and column.role != ""
    )
