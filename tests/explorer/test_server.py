"""What the explorer's server answers is what the library gives, and what is wrong it says."""

import io
import json
import re
from importlib.resources import files
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from page_build.data import list_choices
from scipy.io import wavfile

import stackbounce as sb
from explorer.conftest import ASKED, DROP
from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer import LIMITS


def predicted(server, **asked):
    response = server.post("/api/predict", json=asked)
    assert response.status_code == 200, response.text
    return response.json()


def test_errors_are_carried_as_by_predict(server, drop):
    found = predicted(server, drop=drop, errors={"impact_speed": "5 cm/s", "balls.1.mass": 0.001})
    inputs = {"impact_speed": (drop["impact_speed"], 0.05), "balls.1.mass": (0.057, 0.001)}
    exact = sb.predict(sb.Drop.from_mapping(drop), inputs)
    for name in ("rebound_speeds.1", "energy_retained", "last_release.0"):
        error = exact[name].std_dev
        assert found["values"][name]["error"] == pytest.approx(error, rel=1e-4, abs=1e-9)
    band = found["band"]
    assert found["method"] == exact.method
    low, high = exact.band(band["time"])
    assert np.array(band["position"]) == pytest.approx(np.array([low, high]), abs=1e-7)
    assert np.array(band["force"]).shape == (2, 2, len(band["time"]))


RIGID = {"contacts": [{"law": "Rigid", "restitution": 0.8}] * 2}


def test_errors_of_rigid_balls_have_no_force(server, drop):
    found = predicted(server, drop=drop | RIGID, errors={"contacts.0.restitution": 0.01})
    assert set(found["band"]) == {"time", "position"}
    whole = drop | RIGID | {"gravity": 9.81}
    found = predicted(server, drop=whole, errors={"balls.0.mass": "1 g"}, until=0.4)
    assert found["band"]["time"][-1] == 0.4


@pytest.mark.parametrize(
    ("name", "ratios"),
    [  # Cross 2007: 3 (textbook), 1.19 and 0.77 (section II), 1.83 and 0.23 (Fig. 13), 2.18 (V)
        ("textbook", (1.0, 3.0)),
        ("equal", (0.77, 1.19)),
        ("figure-13", (0.23, 1.83)),
        ("B3-on-B1", (0.55, 2.18)),
    ],
)
def test_presets_are_the_papers(name, ratios):
    drop = next(case.drop for case in list_cases() if case.name == name)
    assert sb.simulate(drop).rebound_ratios == pytest.approx(ratios, abs=0.006)


def test_the_page_knows_the_numbers_of_every_law_and_which_set_its_loss():
    choices = list_choices()
    laws = {law["law"]: law for law in choices["laws"]}
    assert list(laws) == list(sb.model.LAWS)
    units = {field["name"]: field["unit"] for field in laws["HuntCrossley"]["fields"]}
    assert units == {"stiffness": "N/m**exponent", "exponent": "", "dissipation": "s/m"}
    for name, law in laws.items():
        given = {field["name"]: field["default"] for field in law["fields"]}
        assert bool(law["loss_fields"]) == bool(sb.model.LAWS[name].loss)
        given.pop("unloading_exponent", None)  # or the restitution
        assert sb.model.LAWS[name](**given)
    assert laws["Hysteretic"]["loss_fields"] == ["restitution", "unloading_exponent"]
    assert laws[choices["lossy_law"]]["loss_fields"]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"drop": None}, "the scenario must be a table"),
        ({"drop": {}}, "balls is missing"),
        (
            {"drop": DROP | {"balls": DROP["balls"] * LIMITS.balls}},
            "balls must be at most 6 in the explorer, got 12",
        ),
        ({"until": -1}, "until: input should be greater than 0, got -1"),
        ({"until": 61}, "until: input should be less than or equal to 60, got 61"),
        ({"till": 1}, "till: extra inputs are not permitted"),
        ({"errors": {"balls.9.mass": 1}}, "balls.9.mass is not a parameter of this drop"),
        (
            {"errors": {"balls.0.mass": 0}},
            "errors must have a number with an error above 0, got none",
        ),
        ({"errors": {}}, "errors"),
    ],
)
def test_what_is_wrong_is_told(server, asked, message):
    response = server.post("/api/predict", json=ASKED | asked)
    assert response.status_code == 422
    assert message in response.json()["detail"]


@pytest.mark.parametrize("body", [b"", b"[", b"nonsense", b"\xff", b"[" * 60_000, b"1e999"])
def test_a_body_that_is_no_request(server, body):
    headers = {"content-type": "application/json"}
    response = server.post("/api/predict", content=body, headers=headers)
    assert response.status_code in (400, 422)
    assert "\n" not in response.json()["detail"]


def test_the_icon_in_the_page_is_that_of_the_file(server):
    """Chromium asks for an icon in a file again after each change of the address."""
    inside = re.search(r'rel="icon" href="data:image/svg\+xml,([^"]*)"', server.get("/").text)[1]
    assert unquote(inside) == server.get("/icon.svg").text.strip()


EXAMPLES = files("stackbounce.explorer") / "static/examples"
RECORD = (EXAMPLES / "floor-force.csv").read_bytes()


def test_a_record_is_recognised_and_fitted(server, drop):
    file = {"file": ("force.csv", RECORD)}
    seen = server.post("/api/measure", files=file, data={"options": '{"mass": "150 g"}'})
    assert seen.status_code == 200, seen.text
    seen = seen.json()
    assert seen["holds"] == "waveform"
    assert seen["measured"] == {"force.0": "force"}
    assert [curve["what"] for curve in seen["series"]] == ["force"]
    asked = {
        "drop": json.dumps(drop),
        "vary": '["contacts.0.stiffness", "contacts.1.stiffness"]',
        "measured": json.dumps(seen["measured"]),
    }
    found = server.post("/api/fit", files=file, data=asked)
    assert found.status_code == 200, found.text
    found = found.json()
    for value, true in zip(found["values"], (2700.0, 1350.0), strict=False):
        assert abs(value["value"] - true) < 4 * value["error"]
    assert 0.8 < found["chi_squared"] / found["degrees_of_freedom"] < 1.2
    begin = seen["series"][0]["time"][0] - seen["zero"]  # from the touch, as the drop's times
    assert found["series"][0]["time"][0] == pytest.approx(begin, abs=2e-4)


def test_a_table_of_bounces_tells_of_the_contact_laws(server):
    table = b"drop height (cm),rebound height (cm)\n150,81\n100,54\n50,27\n"
    seen = server.post("/api/measure", files={"file": ("heights.csv", table)}).json()
    best = seen["found"][0]
    assert best["name"].startswith("heights.csv: Rigid, Dashpot")
    assert best["value"] == pytest.approx(0.54**0.5, abs=1e-3)
    assert any("agree" in note for note in seen["notes"])


def test_typed_numbers_are_fitted(server, drop):
    vary = ["contacts.0.stiffness", "contacts.1.stiffness"]  # only their ratio matters
    measured = {"rebound_ratios.1": "1.64 ± 0.02", "rebound_ratios.0": "0.58 ± 0.02"}
    asked = {"drop": drop, "vary": vary, "measured": measured}
    asked = {name: json.dumps(value) for name, value in asked.items()}
    found = server.post("/api/fit", data=asked).json()
    expected = sb.fit(sb.Drop.from_mapping(drop), measured, vary)
    assert found["values"][1]["value"] == expected["contacts.1.stiffness"].nominal_value
    assert found["notes"] == [*expected.notes]
    assert len(set(expected.undetermined) & set(expected.notes)) == 1
    assert found["residuals"][0]["name"] == "rebound_ratios.1"


TRACK = (EXAMPLES / "two-tracks.csv").read_bytes()
NOISE = np.random.default_rng(1).integers(-9000, 9000, 20_000).astype("<i2")
EARLY = b"time (s),force (N)\n" + b"".join(b"%de-320,%d\n" % (i, i % 7) for i in range(60))
FORCE = b"Time (s),Force (N)\n" + b"".join(b"%d,0.1\n" % i for i in range(40))


def wav_of(samples, rate):
    file = io.BytesIO()
    wavfile.write(file, rate, samples)
    return file.getvalue()


@pytest.mark.parametrize(
    ("content", "asked", "message"),
    [
        (b"%PDF-1.7", {}, "a.csv: it is a PDF document"),
        (EARLY, {}, ""),
        (wav_of(NOISE, rate=1), {}, "a.csv"),
        (TRACK, {"options": '{"gravity": 1e-320}'}, "a.csv"),
        (FORCE, {"options": "3"}, "options: input should be a valid dictionary, got 3"),
        (FORCE, {"options": "["}, "options: invalid JSON: EOF while parsing a list"),
        (FORCE, {"options": '{"mass": ' + "[" * 500 + "]" * 500 + "}"}, "recursion limit exceeded"),
        (FORCE, {"options": '{"path": "/etc/passwd"}'}, "'path' is no option"),
        (FORCE, {"options": '{"mass": "57 m"}'}, "“Ball's mass” must be a mass"),
        (FORCE, {"options": '{"holds": "gold"}'}, "“Kind of measurement” must be what"),
    ],
)
def test_a_file_that_is_none(server, content, asked, message):
    response = server.post("/api/measure", files={"file": ("dir/a.csv", content)}, data=asked)
    assert response.status_code == 422
    assert message in response.json()["detail"]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"vary": "3"}, "vary: input should be a valid list, got 3"),
        ({"drop": "{"}, "drop: invalid JSON: EOF while parsing an object"),
        ({"measured": '{"force.0": "force"}'}, "force.0 needs a file with a force over time"),
        ({"measured": '{"collisions.0": "%s"}' % ("9" * 5000)}, "collisions.0"),
        ({"measured": '{"\\ud800": "1"}'}, "measured: invalid JSON"),
        ({"measured": "{}"}, "measured: dictionary should have at least 1 item"),
    ],
)
def test_a_fit_that_is_none(server, drop, asked, message):
    whole = {"drop": json.dumps(drop), "vary": '["gaps.0"]'} | asked
    response = server.post("/api/fit", data=whole)
    assert response.status_code == 422
    assert message in response.json()["detail"]


def test_the_page_names_no_law_or_its_loss():
    """All that the page knows of laws is served; a name is only in the drops that it opens with."""
    scripts = files("stackbounce.explorer").joinpath("static/js")
    words = {*sb.model.LAWS, *(law.loss for law in sb.model.LAWS.values() if law.loss)}
    words -= {"restitution"}  # is also a measured quantity
    named = {
        (script.name, word)
        for script in Path(str(scripts)).rglob("*.js")
        if script.name not in ("store.js", "examples.js")
        for word in re.findall(r"\w+", script.read_text(encoding="utf-8"))
        if word in words
    }
    assert not named
