"""Where the engine and compiled code are chosen, and which exceptions mean a lost number."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.engine.entries import ENTRIES
from stackbounce.engine.memory import FINITE, OUT_OF_RANGE
from stackbounce.run import batch, driver

BALLS = [sb.Ball(0.15), sb.Ball(0.057)]
HERTZ = sb.Drop(BALLS, [sb.Hertz(1e5)] * 2, impact_speed=3.53)
BUGS = (TypeError, AttributeError, NameError, IndexError, KeyError, AssertionError)


def broken(monkeypatch, error):
    """Let the finite engine's kernels raise an exception, as plain Python."""

    def raising(*_):
        raise error

    for name in (FINITE.run_drop, FINITE.run_batch):
        monkeypatch.setitem(ENTRIES, name, raising)
    for module in (driver, batch):
        monkeypatch.setattr(module, "choose_compiled", lambda _: False)


@pytest.mark.parametrize("bug", BUGS)
def test_a_programming_error_is_not_taken_for_numbers_out_of_range(monkeypatch, bug):
    broken(monkeypatch, bug("a bug"))
    with pytest.raises(bug, match="a bug"):
        sb.simulate(HERTZ)
    with pytest.raises(bug, match="a bug"):
        sb.sweep(HERTZ, {"balls.0.mass": [1.0, 2.0]}, until=1.0)


@pytest.mark.parametrize("error", OUT_OF_RANGE)
def test_numbers_out_of_range_make_a_run_invalid(monkeypatch, error):
    broken(monkeypatch, error("math"))
    assert sb.simulate(HERTZ).status is sb.Status.INVALID
    swept = sb.sweep(HERTZ, {"balls.0.mass": [1.0, 2.0]}, until=1.0)
    assert swept.status.values.tolist() == [sb.Status.INVALID] * 2


@pytest.mark.parametrize("stiffness", [1e5, 1e308])
@pytest.mark.parametrize("law", [sb.Spring, sb.Hertz, lambda k: sb.Dashpot(k, 1.0)])
def test_a_sweep_has_the_status_of_a_run_out_of_range(law, stiffness):
    drop = sb.Drop([sb.Ball(1e-300), sb.Ball(1.0)], [law(stiffness)] * 2, impact_speed=1e200)
    ds = sb.sweep(drop, {"balls.1.mass": [1.0, 1e300]})
    invalid = ds.status.values == sb.Status.INVALID
    assert np.isnan(ds.rebound_ratio.transpose(..., "ball").values[invalid]).all()
    for mass, status in zip((1.0, 1e300), ds.status.values, strict=True):
        one = sb.Drop([sb.Ball(1e-300), sb.Ball(mass)], [law(stiffness)] * 2, impact_speed=1e200)
        assert sb.simulate(one, compiled=True).status == status
