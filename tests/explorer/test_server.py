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
from explorer.conftest import DROP
from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer import LIMITS


def post(server, path, **asked):
    return server.post(f"/api/{path}", json=asked)


def answer(server, path, **asked):
    response = post(server, path, **asked)
    assert response.status_code == 200, response.text
    return response.json()


def library(drop):
    return sb.simulate(sb.Drop.from_mapping(drop), rtol=1e-10)


def test_a_drop_is_the_librarys_own(server, drop):
    got = answer(server, "simulate", drop=drop)
    result = library(drop)
    assert got["rebound_ratios"] == result.rebound_ratios.tolist()
    assert got["collisions"] == result.collisions.tolist()
    assert got["drop"] == result.drop.to_mapping()
    heights = np.array(got["rebound_speeds"]) ** 2 / (2 * 9.80665)
    assert got["rebound_heights"] == pytest.approx(heights, rel=1e-12)
    assert got["impact"] == [0.0, max(result.last_release)]


@pytest.mark.parametrize("gravity", [0.0, 9.80665])
def test_frames_are_samples(server, drop, gravity):
    frames = answer(server, "simulate", drop=drop | {"gravity": gravity}, frames=200)["frames"]
    result = library(drop | {"gravity": gravity})
    times = np.array(frames["time"])
    assert (np.diff(times) > 0).all()
    assert times[0] < 0.0 < result.end_time < times[-1]
    for moment in [0.0, *result.intervals["end"]]:
        assert moment in times
    late = times >= 0.0
    sample = result.sample(times[late])
    for name in ("position", "velocity", "force", "compression"):
        values = np.array(frames[name])[:, late]
        assert values == pytest.approx(sample[name].values, abs=1e-8 * np.abs(values).max())
    speed, early = 3.53, times[~late]
    fallen = -speed * early - 0.5 * gravity * early**2
    for ball in (0, 1):
        assert np.array(frames["position"])[ball][~late] == pytest.approx(fallen, abs=1e-9)
        velocity = np.array(frames["velocity"])[ball][~late]
        assert velocity == pytest.approx(-speed - gravity * early, abs=1e-7)
    height = np.array(frames["position"])
    assert np.array(frames["compression"])[0] == pytest.approx(-height[0], abs=1e-9)
    assert np.array(frames["compression"])[1] == pytest.approx(height[0] - height[1], abs=1e-9)


def test_energies_add_up(server, drop):
    drop["contacts"][0] = {"law": "Dashpot", "stiffness": 2500.0, "damping": 5.0}
    energy = answer(server, "simulate", drop=drop | {"gravity": 9.81})["frames"]["energy"]
    total = np.array(energy["total"])
    parts = np.sum(energy["kinetic"], axis=0) + energy["stored"] + energy["potential"]
    assert parts == pytest.approx(total, abs=1e-6 * total[0])
    assert total[-1] < 0.9 * total[0]
    assert min(energy["stored"]) == 0.0


def test_the_whole_story_begins_at_rest(server, drop):
    del drop["impact_speed"]
    whole = drop | {"height": 0.5, "gravity": 9.80665}
    frames = answer(server, "simulate", drop=whole, until=1.0)["frames"]
    begin = frames["position"][0][0], frames["velocity"][1][0], frames["time"][-1]
    assert begin == pytest.approx((0.5, 0.0, 1.0), abs=1e-6)


def test_separate_collisions_stand_beside(server, drop):
    drop["contacts"][0] = {"law": "Dashpot", "stiffness": 2500.0, "damping": 5.0}
    got = answer(server, "simulate", drop=drop)
    textbook = sb.separate(sb.Drop.from_mapping(drop))
    result = sb.simulate(textbook)
    assert got["separate"]["rebound_ratios"] == result.rebound_ratios.tolist()
    assert got["separate"]["restitutions"][1] == 1.0
    assert got["separate"]["restitutions"][0] < 0.95
    times = np.array(got["frames"]["time"])
    place = result.sample(times[times >= 0.0]).position.values
    assert np.array(got["separate"]["position"])[:, times >= 0.0] == pytest.approx(place, abs=1e-8)


def test_errors_are_carried_as_by_predict(server, drop):
    asked = {"impact_speed": "5 cm/s", "balls.1.mass": 0.001}
    found = answer(server, "predict", drop=drop, errors=asked)
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
    found = answer(server, "predict", drop=drop | RIGID, errors={"contacts.0.restitution": 0.01})
    assert set(found["band"]) == {"time", "position"}
    whole = drop | RIGID | {"gravity": 9.81}
    found = answer(server, "predict", drop=whole, errors={"balls.0.mass": "1 g"}, until=0.4)
    assert found["band"]["time"][-1] == 0.4


def test_a_rigid_drop_has_no_other(server, drop):
    got = answer(server, "simulate", drop=drop | RIGID)
    assert got["separate"] is None
    assert got["intervals"][0]["peak_force"] is None
    assert got["impact"] == [0.0, 0.0]


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
    ("path", "asked", "message"),
    [
        ("simulate", {}, "drop: field required"),
        ("simulate", {"drop": {}}, "balls is missing"),
        ("simulate", {"drop": 3}, "the scenario must be a table"),
        (
            "simulate",
            {"drop": DROP | {"balls": DROP["balls"] * LIMITS.balls}},
            "balls must be at most 6 in the explorer, got 12",
        ),
        (
            "simulate",
            {"drop": DROP, "frames": 10**6},
            "frames: input should be less than or equal to 3000",
        ),
        ("simulate", {"drop": DROP, "until": -1}, "until: input should be greater than 0, got -1"),
        ("simulate", {"drop": DROP, "till": 1}, "till: extra inputs are not permitted"),
        (
            "predict",
            {"drop": DROP, "errors": {"balls.9.mass": 1}},
            "balls.9.mass is not a parameter of this drop",
        ),
        (
            "predict",
            {"drop": DROP, "errors": {"balls.0.mass": 0}},
            "errors must have a number with an error above 0, got none",
        ),
        ("predict", {"drop": DROP, "errors": {}}, "errors"),
    ],
)
def test_what_is_wrong_is_told(server, path, asked, message):
    response = post(server, path, **asked)
    assert response.status_code == 422
    assert message in response.json()["detail"]


def test_a_run_without_end_says_so(server, drop):
    endless = drop | {"contacts": [{"law": "Spring", "stiffness": 1e6}] * 2, "gravity": 9.81}
    got = answer(server, "simulate", drop=endless, until=LIMITS.duration, frames=50)
    assert got["status"] in ("TIME_REACHED", "EVENT_LIMIT")
    assert got["frames"]["time"][-1] <= LIMITS.duration


@pytest.mark.parametrize("body", [b"", b"[", b"nonsense", b"\xff", b"[" * 60_000, b"1e999"])
def test_a_body_that_is_no_request(server, body):
    headers = {"content-type": "application/json"}
    response = server.post("/api/simulate", content=body, headers=headers)
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
    vary, measured = ["contacts.1.stiffness"], {"rebound_ratios.1": "1.64 ± 0.02"}
    asked = {"drop": drop, "vary": vary, "measured": measured}
    asked = {name: json.dumps(value) for name, value in asked.items()}
    found = server.post("/api/fit", data=asked).json()
    expected = sb.fit(sb.Drop.from_mapping(drop), measured, vary)
    assert found["values"][0]["value"] == expected["contacts.1.stiffness"].nominal_value
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
