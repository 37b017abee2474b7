"""The schema of requests: pydantic models around the package's own dataclasses.

`Drop.from_mapping` reads a drop, as it does from TOML, so units and messages are the same.
pydantic adds the OpenAPI description and the limits of a request. What an answer has is said by
the functions in `answers/`.
"""

from collections.abc import Callable
from dataclasses import MISSING, fields
from typing import Annotated, Any, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from stackbounce.errors import InvalidValue, shown
from stackbounce.explorer.limits import LIMITS
from stackbounce.model import LAWS, Ball, Drop
from stackbounce.model.schema import NO_FLOOR
from stackbounce.units import unit_of

_Json = dict[str, Any]


class _Reader:
    """Makes a pydantic type from a function that reads a value and one that describes it."""

    def __init__(self, read: Callable[[object], Any], describe: Callable[[], _Json]) -> None:
        self._read, self._describe = read, describe

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._read)

    def __get_pydantic_json_schema__(self, _: CoreSchema, __: GetJsonSchemaHandler) -> _Json:
        return self._describe()


def read_drop(value: object) -> Drop:
    """Read a drop from a mapping; refuse one with too many balls.

    Raises
    ------
    ScenarioError, InvalidValue
        If it is no drop, or has too many balls.

    Examples
    --------
    >>> contact = {"law": "Spring", "stiffness": "22.5 kN/m"}
    >>> drop = {"balls": [{"mass": "57 g"}], "contacts": [contact], "impact_speed": 1}
    >>> read_drop(drop).balls[0].mass
    0.057
    """
    if isinstance(value, dict):
        for name in ("balls", "contacts", "gaps", "velocities"):
            many = value.get(name)
            if isinstance(many, list) and len(many) > LIMITS.balls:
                raise InvalidValue(
                    f"{name} must be at most {LIMITS.balls} in the explorer, got {len(many)}"
                )
    return Drop.from_mapping(value)  # type: ignore[arg-type]


def _describe_drop() -> _Json:
    drop = _describe(Drop)
    laws = [_describe(law, name) for name, law in LAWS.items()]
    laws.append(_describe_object({"law": {"const": NO_FLOOR}}, ["law"]))
    drop["properties"]["balls"] = _describe_list(_describe(Ball), 1)
    drop["properties"]["contacts"] = _describe_list({"anyOf": laws}, 1)
    return drop


def _describe(kind: type, law: str | None = None) -> _Json:
    """Return the JSON schema of a dataclass; its numbers may be texts with a unit."""
    properties: _Json = {} if law is None else {"law": {"const": law}}
    hints = get_type_hints(kind, include_extras=True)
    given = [entry for entry in fields(kind) if entry.init and not entry.name.startswith("_")]
    properties |= {entry.name: _describe_field(hints[entry.name]) for entry in given}
    missing = [entry.name for entry in given if entry.default is MISSING]
    return _describe_object(properties, ([] if law is None else ["law"]) + missing)


def _describe_field(hint: Any) -> _Json:
    unit = unit_of(hint)
    if unit is None:
        return {"type": "string"}
    meaning = f"in {unit.symbol}, or a text with a unit" if unit.symbol else "a pure number"
    number: _Json = {"anyOf": [{"type": "number"}, {"type": "string"}], "description": meaning}
    return _describe_list(number, 0) if "Sequence" in str(hint) else number


def _describe_list(items: _Json, least: int) -> _Json:
    return {"type": "array", "items": items, "minItems": least, "maxItems": LIMITS.balls}


def _describe_object(properties: _Json, required: list[str]) -> _Json:
    return {
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


Scenario = Annotated[Drop, _Reader(read_drop, _describe_drop)]
"""A drop, with the keys and units of a scenario file."""

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Name = Annotated[str, Field(max_length=100)]

Varied = Annotated[list[_Name], Field(min_length=1, max_length=LIMITS.varied)]
"""Paths of the numbers that a fit varies."""

Texts = Annotated[dict[_Name, str], Field(min_length=1)]
"""What was measured, with errors: ``{"rebound_ratios.1": "1.64 ± 0.02"}``."""


def describe_error(error: Any) -> str:
    """Describe a pydantic error in one line: the field, what is wrong, and the value.

    Examples
    --------
    >>> describe_error({"type": "missing", "loc": ("body", "x", "low"), "msg": "Field required"})
    'x.low: field required'
    """
    if error["type"] == "value_error":  # raised by this package; its message begins with the path
        return str(error["ctx"]["error"])
    if not any(isinstance(part, str) for part in error["loc"][1:]):  # of no field
        return "the request must be an object in JSON, with content-type application/json"
    where = ".".join(str(part) for part in error["loc"] if part != "body")
    where = where if where.isprintable() and len(where) <= 60 else shown(where)
    words = error["msg"][:1].lower() + error["msg"][1:]
    got = "" if error["type"] == "missing" else f", got {shown(error['input'])}"
    return f"{where}: {words}{got}"


class Request(BaseModel):
    """The body of a request: a JSON object without unknown keys."""

    model_config = ConfigDict(extra="forbid")


class _Run(Request):
    """A drop, and the end of its run."""

    drop: Scenario
    until: Annotated[float, Field(gt=0.0, le=LIMITS.duration)] | None = None


class Play(_Run):
    """A drop to simulate."""

    frames: Annotated[int, Field(ge=2, le=LIMITS.frames)] = 1200


class Uncertain(_Run):
    """A drop, and the errors of some of its numbers by path: SI numbers, or texts with a unit."""

    errors: Annotated[dict[_Name, _Finite | _Name], Field(min_length=1, max_length=LIMITS.varied)]


class Problem(BaseModel):
    """What was wrong, in one line."""

    detail: str
