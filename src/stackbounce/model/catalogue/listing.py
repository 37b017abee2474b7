"""The balls of the catalogue by name, as a table that shows itself."""

from collections.abc import Iterator, Mapping, Sequence

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.balls import BALLS, CLASS_BALLS, UNITS
from stackbounce.model.catalogue.stacking import catalogue_ball
from stackbounce.shown import Shown, Table
from stackbounce.units import handy_text

_FIGURES = ("mass", "diameter", "restitution", "contact_time", "stiffness")


class Balls(Shown, Mapping[str, Ball]):
    """The balls of the catalogue by name; `stackbounce.balls` is the one there is.

    Names are read as by `stack`. What is not there raises a `KeyError` that is an `InvalidValue`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> sb.balls["tennis"].mass, "golf ball" in sb.balls
    (0.057, True)
    """

    def __getitem__(self, name: str) -> Ball:
        return catalogue_ball(name).ball

    def __iter__(self) -> Iterator[str]:
        return (str(entry.ball.name) for entry in (*BALLS, *CLASS_BALLS))

    def __len__(self) -> int:
        return len(BALLS) + len(CLASS_BALLS)

    def _tables(self) -> Sequence[Table]:
        rows = []
        for name in self:
            numbers = catalogue_ball(name).to_mapping()
            known = (numbers.get(figure) for figure in _FIGURES)
            cells = zip(known, (UNITS[figure] for figure in _FIGURES), strict=True)
            rows.append((name, *("" if x is None else handy_text(x, unit, 4) for x, unit in cells)))
        columns = ("", *(figure.replace("_", " ") for figure in _FIGURES))
        return (Table("Balls of the catalogue", columns, rows),)


balls = Balls()
"""The balls of the catalogue by name."""
