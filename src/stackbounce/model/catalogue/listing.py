"""The balls of the catalogue by name, as a table that shows itself."""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.balls import BALLS, CLASS_BALLS
from stackbounce.model.catalogue.stacking import catalogue_ball
from stackbounce.shown import Shown

if TYPE_CHECKING:
    import pandas as pd


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

    @property
    def table(self) -> "pd.DataFrame":
        """The figures of all balls, a row each; ``stackbounce balls`` prints their sources."""
        import pandas as pd

        entries = [catalogue_ball(name) for name in self]
        figures = {
            "mass/g": [1e3 * entry.ball.mass for entry in entries],
            "diameter/mm": [1e3 * (entry.ball.diameter or math.nan) for entry in entries],
            "restitution": [entry.restitution for entry in entries],
            "contact time/ms": [1e3 * (entry.contact_time or math.nan) for entry in entries],
            "stiffness/(N/m)": [entry.stiffness for entry in entries],
        }
        return pd.DataFrame(figures, index=list(self))


balls = Balls()
"""The balls of the catalogue by name."""
