"""The schema of requests: pydantic models around the package's own dataclasses.

`Drop.from_mapping` reads a drop, as it does from TOML, so units and messages are the same.
pydantic adds the OpenAPI description and the limits of a request. What an answer has is said by
the functions in `answers/`.
"""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, PlainValidator, WithJsonSchema

from stackbounce.errors import InvalidValue, shown
from stackbounce.explorer.limits import LIMITS
from stackbounce.model import Drop


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


_SPRING = {"law": "Spring", "stiffness": "22.5 kN/m"}
_DROP = {
    "type": "object",
    "description": "A drop, with the keys and units of a scenario file; see `stackbounce.Drop`.",
    "examples": [{"balls": [{"mass": "57 g"}], "contacts": [_SPRING], "height": "1 m"}],
}

Scenario = Annotated[Drop, PlainValidator(read_drop), WithJsonSchema(_DROP)]
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


class Uncertain(BaseModel):
    """A drop, the end of its run, and errors by path: SI numbers, or texts with a unit."""

    model_config = ConfigDict(extra="forbid")

    drop: Scenario
    until: Annotated[float, Field(gt=0.0, le=LIMITS.duration)] | None = None
    errors: Annotated[dict[_Name, _Finite | _Name], Field(min_length=1, max_length=LIMITS.varied)]


class Problem(BaseModel):
    """What was wrong, in one line."""

    detail: str
