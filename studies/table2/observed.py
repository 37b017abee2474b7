"""What the paper observed of a pair: ratios from the heights that the balls reach."""

from dataclasses import fields

import numpy as np

from stackbounce import Drop, simulate
from stackbounce.fitting import FitProblem
from stackbounce.fitting.objective import Objective
from stackbounce.run.paths import drop_at
from studies.table2 import inputs
from studies.table2.inputs import Array

_RTOL = 1e-6
_LATER = 40e-3  # s: every impact is over, and no ball is back on the floor
_HEIGHT = "height"


def observe(model: FitProblem) -> "Observed":
    """Return the objective of a model with data."""
    whole = model.objective
    own = {field.name: getattr(whole, field.name) for field in fields(whole) if field.init}
    return Observed(**{**own, "rtol": _RTOL})


class Observed(Objective):
    """An objective that also knows drops with gravity, and a drop height with an error.

    With gravity a ratio e is that of a height: the height that a ball reaches is e**2 times the
    drop height. It is computed from position and speed 40 ms after the first touch. Speeds at a
    fixed time cannot be compared with Table II, because the balls slow down.

    The paper has ratios to a drop height of 20 cm. If the height is another one, all of them change
    by the same factor.
    """

    def predict(self, key: str, x: Array) -> Array:
        """Return what trials (n, parameters) predict for one pair's data: (n, data)."""
        falls = self.drops[key].gravity > 0.0
        found = self._fall(key, x) if falls else super().predict(key, x)
        if _HEIGHT in self.names:
            factor = np.sqrt(self.values(x)[_HEIGHT] / inputs.HEIGHT)
            for k, datum in enumerate(self.measured[key].data):
                if datum.quantity == "rebound_ratios":
                    found[:, k] *= factor
        return found

    def _fall(self, key: str, x: Array) -> Array:
        """Return the same with gravity; equal drops are run once."""
        rows = self.rows(key, x)
        table = np.stack([np.broadcast_to(row, len(x)) for row in rows.values()], axis=1)
        different, where = np.unique(table, axis=0, return_inverse=True)
        found = [
            self._one(key, drop_at(self.drops[key], dict(zip(rows, row.tolist(), strict=True))))
            for row in different
        ]
        return np.array(found)[where.ravel()]

    def _one(self, key: str, drop: Drop) -> list[float]:
        result = simulate(drop, until=_LATER, rtol=self.rtol)
        heights = np.ravel(result.rerun([_LATER]).samples.position)
        squares = result.rebound_speeds**2 + 2.0 * drop.gravity * heights
        known = {
            "rebound_ratios": np.sqrt(np.maximum(squares, 0.0)) / drop.reference_speed,
            "first_touch": result.first_touch,
        }
        return [float(known[datum.quantity][datum.index]) for datum in self.measured[key].data]
