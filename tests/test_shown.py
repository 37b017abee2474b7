"""Values and results show themselves on one screen, as text and as HTML."""

import sys
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import shown
from stackbounce.model.catalogue import catalogue_ball, stacked

CHOSEN = stacked(["basketball", "tennis"])
DROP = sb.Drop(CHOSEN.balls, CHOSEN.contacts, gaps=[0.002], height=0.63)
ODD = sb.Drop([sb.Ball(0.1), sb.Ball(0.05, name="<b>&\x1b\n")], [sb.Spring(1e3)] * 2, height=1.0)
MANY = sb.Drop([sb.Ball(0.1)] * 100, [sb.Rigid(0.9)] * 100, impact_speed=1.0)
ROW = sb.Drop([sb.Ball(0.2)] * 9, [None] + [sb.Rigid(1.0)] * 8, velocities=[1.0] + [0.0] * 8)
LONG = sb.Drop([sb.Ball(1.0)] * 2, [sb.StandardLinearSolid(2e4, 0.123456, 1e-3)] * 2, height=1.0)
X = np.linspace(0.0, 5e-3, 50)
DATA = {"rebound_ratios": ["0.3 ± 0.1", "1.8 ± 0.1"]}
VALUES = (DROP, ODD, MANY, LONG, DROP.balls[0], sb.Hysteretic(2e4, restitution=0.8))
SHOWN = dict(enumerate(VALUES)) | {
    "table": sb.Tabulated([0.0, 1e-3, 2e-3], [0.0, 5.0, 20.0]),
    "catalogue": catalogue_ball("tennis"),
    "result": lambda: sb.simulate(ODD),
    "row": lambda: sb.simulate(ROW),
    "prediction": lambda: sb.predict(DROP, {"height": (0.63, 0.01)}),
    "fit": lambda: sb.fit(DROP, DATA, ["contacts.0.stiffness"]),
    "posterior": lambda: sb.fit(DROP, DATA, ["contacts.0.stiffness"]).sample(6400),
    "comparison": lambda: sb.compare(sb.standard_models(DROP), DATA),
    "series": lambda: sb.fit_series("dataset:golf-marble-heights"),
    "press": lambda: sb.measure.press((X, 2e4 * X)),
    "finding": lambda: sb.measure.bounces([0.0, 0.8, 1.44, 1.952]),
}


@pytest.mark.parametrize("name", SHOWN)
def test_each_fits_on_a_screen_and_is_whole_html(name):
    value = SHOWN[name]() if callable(SHOWN[name]) else SHOWN[name]
    lines = repr(value).splitlines()
    assert len(lines) <= 40
    assert max(map(len, lines)) <= 80
    assert "None" not in repr(value)
    page = ET.fromstring(f"<div>{value._repr_html_()}</div>")
    assert page.find("table/tbody") is not None
    assert all(drawing.get("aria-label") for drawing in page.iter("svg"))
    assert "\n" not in shown(value)


def test_a_drop_stands_as_it_falls():
    above, first, contact, *_, floor = repr(DROP).splitlines()
    assert above == "Drop from 0.63 m, at 3.515 m/s"
    assert first == "tennis       57 g, 66 mm"
    assert contact == "  contact 1  Spring, stiffness 1000 N/m, gap 2 mm"
    assert floor == "floor"
    assert "<b>&??" in repr(ODD)


def test_a_result_says_what_to_do(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)  # a plain installation has none
    stopped = sb.simulate(DROP, until=0.01)
    assert repr(stopped).endswith("was reached first: raise until to see more")
    assert "TIME_REACHED" in stopped._repr_html_()
    assert "FINISHED" not in repr(sb.simulate(DROP))
