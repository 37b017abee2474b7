"""What a piezo sensor's amplifier lets leak away, and how it is put back."""

import re

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.droop import undrooped
from synthetic.waveform import drooped
from synthetic.waveform import waveform as record_of

ONE = sb.simulate(sb.Drop([sb.Ball(0.1)], [sb.Spring(6e4)], impact_speed=2.0))
TIME = float(ONE.intervals["end"][0])


@pytest.mark.parametrize("time_constant", [1e-4, 1e-2, 10.0])
def test_the_two_undo_each_other(time_constant):
    random = np.random.default_rng(1)
    times = np.cumsum(random.uniform(0.5e-4, 2e-4, 1000))
    force = np.cumsum(random.normal(size=1000))
    back = undrooped(times, drooped(times, force, time_constant), time_constant)
    assert back == pytest.approx(force, abs=1e-8)


def test_a_half_sine_after_a_high_pass_has_its_known_end():
    rc, tau = 2e-3, 4e-3
    times = np.linspace(0.0, tau, 4001)
    out = drooped(times, np.sin(np.pi * times / tau), rc)
    w = np.pi / tau * rc
    expected = -w / (1.0 + w**2) * (1.0 + np.exp(-tau / rc))
    assert out[-1] == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("time_constant", [4e-3, 2e-2, 0.5])
@pytest.mark.parametrize("offset", [0.0, -7.0])
def test_droop_is_put_back(time_constant, offset):
    how = {"noise": 0.5, "offset": offset, "time_constant": time_constant, "before": 0.01}
    record = record_of(ONE, rate=1e5, **how)
    found = waveform(record, time_constant=time_constant)
    (contact,) = found.contacts
    assert abs(contact.time.nominal_value - TIME) < 4.0 * contact.time.std_dev
    assert abs(contact.impulse.nominal_value - 0.4) < max(4.0 * contact.impulse.std_dev, 1e-3)


def test_droop_that_is_not_put_back_is_said_with_its_time_constant():
    record = record_of(ONE, rate=1e5, noise=0.2, time_constant=0.04, before=0.01)
    (note,) = [one for one in waveform(record).notes if "droop" in one]
    assert re.search(r"about 0\.0(3[5-9]|4[0-5]?) s|about 0\.04\d s", note)
    assert not any("droop" in one for one in waveform(record, time_constant=0.04).notes)


def test_a_wrong_time_constant_is_refused():
    with pytest.raises(InvalidValue, match="time_constant must be a positive number of seconds"):
        undrooped([0.0, 1.0], [0.0, 1.0], -1.0)
    with pytest.raises(InvalidValue, match="times and values of one length"):
        undrooped([0.0, 1.0], [0.0], 1.0)
