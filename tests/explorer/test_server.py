"""What the explorer's server answers is what the library gives, and what is wrong it says."""

import csv
import io
import json
import re
import struct
import xml.etree.ElementTree as ET
from importlib.resources import files
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer import LIMITS
from stackbounce.explorer.answers.examples import list_examples


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
    assert frames["position"][0][0] == pytest.approx(0.5, abs=1e-9)
    assert frames["velocity"][1][0] == pytest.approx(0.0, abs=1e-6)
    assert frames["time"][-1] == 1.0


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
    plain = sb.Drop.from_mapping(drop)
    exact = sb.predict(
        plain,
        {"impact_speed": (plain.impact_speed, 0.05), "balls.1.mass": (plain.balls[1].mass, 0.001)},
    )
    for name in ("rebound_speeds.1", "energy_retained", "last_release.0"):
        assert found["values"][name]["error"] == pytest.approx(
            exact[name].std_dev, rel=1e-4, abs=1e-9
        )
    band = found["band"]
    assert found["method"] == exact.method
    low, high = exact.band(band["time"])
    assert np.array(band["position"]) == pytest.approx(np.array([low, high]), abs=1e-7)
    assert np.array(band["force"]).shape == (2, 2, len(band["time"]))


def test_errors_of_rigid_balls_have_no_force(server, drop):
    rigid = drop | {"contacts": [{"law": "Rigid", "restitution": 0.8}] * len(drop["balls"])}
    found = answer(server, "predict", drop=rigid, errors={"contacts.0.restitution": 0.01})
    assert set(found["band"]) == {"time", "position"}
    whole = rigid | {"gravity": 9.81}
    found = answer(server, "predict", drop=whole, errors={"balls.0.mass": "1 g"}, until=0.4)
    assert found["band"]["time"][-1] == 0.4


@pytest.mark.parametrize(
    ("errors", "message"),
    [
        ({"balls.9.mass": 1}, "balls.9.mass is not a parameter of this drop"),
        ({"balls.0.mass": "1 cm"}, "error of balls.0.mass must be a mass"),
        ({"balls.0.mass": -1}, "balls.0.mass's error must be 0 or above, got -1"),
        ({"balls.0.mass": 0}, "errors must have a number with an error above 0, got none"),
        ({}, "errors"),
    ],
)
def test_errors_that_are_none(server, drop, errors, message):
    response = post(server, "predict", drop=drop, errors=errors)
    assert response.status_code == 422
    assert message in response.json()["detail"]


def test_a_rigid_drop_has_no_other(server, drop):
    rigid = drop | {"contacts": [{"law": "Rigid", "restitution": 0.8}] * 2}
    got = answer(server, "simulate", drop=rigid)
    assert got["separate"] is None
    assert got["intervals"][0]["peak_force"] is None
    assert got["impact"] == [0.0, 0.0]


@pytest.mark.slow
def test_all_presets_play(server):
    catalogue = server.get("/api/catalogue").json()
    names = [preset["name"] for preset in catalogue["presets"]]
    assert names == [case.name for case in (*list_examples(), *list_cases())]
    for preset in catalogue["presets"]:
        assert answer(server, "simulate", drop=preset["drop"])["status"] == "FINISHED"


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


def test_the_catalogue_names_every_number_of_every_law(server):
    laws = {law["law"]: law for law in server.get("/api/catalogue").json()["laws"]}
    assert list(laws) == list(sb.model.LAWS)
    hunt = {field["name"]: field for field in laws["HuntCrossley"]["fields"]}
    assert {name: field["unit"] for name, field in hunt.items()} == {
        "stiffness": "N/m**exponent",
        "exponent": "",
        "dissipation": "s/m",
    }
    for law in laws.values():
        assert law["formula"]
        assert law["says"]
        assert law["source"]
        given = {field["name"]: field["default"] for field in law["fields"]}
        given.pop("unloading_exponent", None)  # or the restitution
        assert sb.model.LAWS[law["law"]](**given)


def test_the_catalogue_names_what_sets_the_loss_of_every_law(server):
    catalogue = server.get("/api/catalogue").json()
    lossy = {law["law"]: law["loss_fields"] for law in catalogue["laws"]}
    assert lossy["Spring"] == []
    assert lossy["Dashpot"] == ["damping"]
    assert lossy["Hysteretic"] == ["restitution", "unloading_exponent"]
    for name, fields in lossy.items():
        assert set(fields) <= set(sb.model.LAWS[name].quantities())
        assert bool(fields) == bool(sb.model.LAWS[name].loss)
    assert lossy[catalogue["lossy_law"]]


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


@pytest.mark.parametrize("name", list(sb.model.LAWS))
def test_a_floor_of_any_law_is_put_where_there_was_none(server, name):
    asked = {"contact": {"law": "none"}, "to": name, "mass": 0.1, "impact_speed": 2.0}
    law = sb.Drop.from_mapping(
        {
            "balls": [{"mass": 0.1}],
            "contacts": [answer(server, "like", **asked)["contact"]],
            "impact_speed": 2.0,
        }
    ).contacts[0]
    lossy = bool(sb.model.LAWS[name].loss)
    assert sb.restitution(law, 0.1, 2.0) == pytest.approx(0.8 if lossy else 1.0, rel=1e-9)
    assert sb.contact_time(law, 0.1, 2.0) == pytest.approx(0.0 if law.rigid else 5e-3, rel=1e-9)


def test_balls_of_the_catalogue_are_stacked(server):
    got = answer(server, "stack", balls=["B1", "B2"], height=0.2)
    assert got["drop"]["gaps"] == [0.001]
    assert got["drop"]["height"] == 0.2
    assert got["gap_sources"] == ["Cross 2007, section V, Figure 13"]


@pytest.mark.parametrize("law", ["Dashpot", "Viscoelastic", "HuntCrossley", "Hysteretic"])
def test_a_law_has_what_was_measured(server, law):
    asked = {"mass": 0.057, "restitution": 0.75, "contact_time": 5e-3, "impact_speed": 3.0}
    contact = answer(server, "law", law=law, **asked)["contact"]
    drop = sb.Drop.from_mapping(
        {"balls": [{"mass": 0.057}], "contacts": [contact], "impact_speed": 3}
    )
    result = sb.simulate(drop)
    assert result.rebound_ratios[0] == pytest.approx(0.75, rel=1e-6)
    assert result.end_time == pytest.approx(5e-3, rel=1e-6)


@pytest.mark.parametrize("law", list(sb.model.LAWS))
def test_another_law_is_like_this_one(server, law):
    contact = {"law": "HuntCrossley", "stiffness": 1e6, "exponent": 1.5, "dissipation": 0.1}
    asked = {"contact": contact, "to": law, "mass": 0.1, "impact_speed": 2.0}
    found = answer(server, "like", **asked)["contact"]
    assert found["law"] == law

    def bounced(one):
        whole = {"balls": [{"mass": 0.1}], "contacts": [one], "impact_speed": 2.0}
        return sb.simulate(sb.Drop.from_mapping(whole))

    if law not in ("Spring", "Hertz", "PowerLaw"):
        ratios = [bounced(one).rebound_ratios[0] for one in (contact, found)]
        assert ratios[1] == pytest.approx(ratios[0], rel=1e-6)
    if not sb.model.LAWS[law].rigid:
        assert bounced(found).end_time == pytest.approx(bounced(contact).end_time, rel=1e-6)


SIDES = {
    "x": {"path": "mass_ratio", "low": 0.1, "high": 10, "count": 5, "log": True},
    "y": {"path": "stiffness_ratio", "low": 0.5, "high": 8, "count": 4, "log": True},
}


def test_a_map_is_a_sweep(server, drop):
    got = answer(server, "map", drop=drop, **SIDES, show="rebound_ratio.1")
    base = sb.Drop.from_mapping(drop)
    masses = np.geomspace(0.1, 10, 5) * 0.057
    stiffnesses = np.geomspace(0.5, 8, 4) * 1000.0
    varied = {"contacts.0.stiffness": stiffnesses, "balls.0.mass": masses}
    expected = sb.sweep(base, varied).rebound_ratio[..., 1].values
    assert np.array(got["values"]) == pytest.approx(expected, rel=1e-12)
    assert got["x"]["label"].startswith("mass ratio")
    assert got["unfinished"] == 0


def test_a_ratio_follows_what_varies_too(server, drop):
    side = {"path": "balls.1.mass", "low": 0.01, "high": 0.1, "count": 3}
    got = answer(server, "map", drop=drop, x=SIDES["x"], y=side, show="rebound_height.1")
    mass = np.linspace(0.01, 0.1, 3)[2]
    drop["balls"] = [{"mass": mass * 10 ** (-0.5)}, {"mass": mass}]
    speed = library(drop).rebound_speeds[1]
    assert got["values"][2][1] == pytest.approx(speed**2 / (2 * 9.80665), rel=1e-6)
    assert got["unit"] == "m"


@pytest.mark.parametrize("path", ["impact_speed", "gravity"])
def test_heights_follow_the_speed_that_comes_in(server, drop, path):
    side = {"path": path, "low": 1.0, "high": 4.0, "count": 2}
    got = answer(server, "map", drop=drop, x=side, y=SIDES["x"], show="rebound_height.0")
    mass = 0.1 * 0.057
    first = drop | {"balls": [{"mass": mass}, {"mass": 0.057}], path: 4.0}
    speed = library(first).rebound_speeds[0]
    assert got["values"][0][1] == pytest.approx(speed * abs(speed) / (2 * 9.80665), rel=1e-6)


def test_a_collapse_is_an_end_on_a_map_too(server):
    drop = {
        "balls": [{"mass": 0.004}, {"mass": 0.057}],
        "contacts": [{"law": "Rigid", "restitution": 1.0}, {"law": "Rigid", "restitution": 0.1}],
        "gaps": [0.001],
        "impact_speed": 3.53,
    }
    x = {"path": "balls.0.mass", "low": 0.004, "high": 0.5, "count": 2}
    y = {"path": "impact_speed", "low": 1.0, "high": 2.0, "count": 2}
    got = answer(server, "map", drop=drop, x=x, y=y, show="collisions.1")
    assert got["values"] == [[-1, 1], [-1, 1]]
    assert got["unfinished"] == 0


def test_what_a_map_can_have(server, drop):
    got = answer(server, "map/paths", drop=drop)
    values = {path["path"]: path["value"] for path in got["paths"]}
    assert values["mass_ratio"] == pytest.approx(150 / 57)
    assert values["gaps.0"] == 0.0
    assert {show["show"] for show in got["shows"]} >= {"energy_retained", "collisions.1"}


WRONG = [
    ("simulate", {"drop": {}}, "balls is missing"),
    ("simulate", {"drop": 3}, "the scenario must be a table"),
    ("simulate", {}, "drop: field required"),
    ("simulate", {"frames": 10**6}, "frames: input should be less than or equal to 3000"),
    ("simulate", {"until": -1}, "until: input should be greater than 0, got -1"),
    ("simulate", {"till": 1}, "till: extra inputs are not permitted"),
    ("law", {"law": "Spring"}, "mass: field required"),
    ("law", {"law": "Sprung", "mass": 1}, "did you mean Spring? Known: Rigid, RigidBySpeed,"),
    ("stack", {"balls": ["B7"]}, "ball must be one of the catalogue, got 'B7'; known"),
    ("map", {"x": SIDES["x"], "y": SIDES["x"]}, "x and y must be two numbers, got mass_ratio"),
    (
        "map",
        {"x": SIDES["x"], "y": {**SIDES["y"], "path": "balls.0.mass"}},
        "x and y must be independent, got mass_ratio and balls.0.mass",
    ),
    ("map", {**SIDES, "show": "rebound_ratio.7"}, "'rebound_ratio.7' is no outcome"),
    ("map", {"x": SIDES["x"], "y": {**SIDES["y"], "low": 0}}, "low must be above 0"),
    ("map", {"x": SIDES["x"], "y": {**SIDES["y"], "low": 8}}, "high must differ from low, got 8"),
    (
        "map",
        {"x": {**SIDES["x"], "count": 999}, "y": {**SIDES["y"], "count": 999}},
        "x.count times y.count must be at most 40000, got 998001",
    ),
    (
        "map",
        {"x": SIDES["x"], "y": {**SIDES["y"], "path": "gap"}},
        "'gap' is not a parameter",
    ),
]


@pytest.mark.parametrize(("path", "asked", "message"), WRONG)
def test_what_is_wrong_is_told(server, drop, path, asked, message):
    needs_drop = path in ("simulate", "map") and asked
    response = post(server, path, **({"drop": drop} if needs_drop else {}) | asked)
    assert response.status_code == 422
    assert message in response.json()["detail"]


def test_a_tower_is_at_most_so_high(server, drop):
    drop["balls"] *= LIMITS.balls
    response = post(server, "simulate", drop=drop)
    assert response.json()["detail"] == "balls must be at most 6 in the explorer, got 12"


def test_a_map_of_all_numbers_is_none(server, drop):
    wide = {"path": "balls.0.mass", "low": -1.7e308, "high": 1.7e308, "count": 3}
    response = post(server, "map", drop=drop, x=wide, y=SIDES["y"])
    assert "low and high must be nearer to each other" in response.json()["detail"]


def test_a_run_without_end_says_so(server, drop):
    drop["contacts"] = [{"law": "Spring", "stiffness": 1e6}] * 2
    until = LIMITS.duration
    got = answer(server, "simulate", drop=drop | {"gravity": 9.81}, until=until, frames=50)
    assert got["status"] in ("TIME_REACHED", "EVENT_LIMIT")
    assert got["frames"]["time"][-1] <= until


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


def test_exports(server, drop):
    def export(kind):
        response = post(server, f"export/{kind}", drop=drop)
        assert response.status_code == 200
        assert "attachment" in response.headers["content-disposition"]
        return response.content

    rows = list(csv.reader(io.StringIO(export("csv").decode())))
    table = np.array(rows[1:], dtype=float)
    result = library(drop)
    late = table[:, 0] >= 0.0
    force = result.sample(table[late, 0]).force.values[1]
    assert rows[0][6] == "force 1 (N)"
    assert table[late, 6] == pytest.approx(force, abs=1e-9)
    assert sb.Drop.from_mapping(drop).to_toml().encode() == export("toml")
    assert export("png").startswith(b"\x89PNG")
    assert ET.fromstring(export("svg")).tag.endswith("svg")
    assert export("svg") == export("svg")


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("name", [r"$\frac{$", "5 $ and $", "a\x00b\x1b", "\ufffe", "<&>"])
@pytest.mark.parametrize("kind", ["svg", "png"])
def test_any_name_can_be_drawn(server, drop, kind, name):
    drop["balls"][0]["name"] = name
    response = post(server, f"export/{kind}", drop=drop)
    assert response.status_code == 200
    if kind == "svg":
        assert ET.fromstring(response.content).tag.endswith("svg")


def test_the_lines_of_python_reproduce_the_drop(server, drop, tmp_path, monkeypatch, capsys):
    drop["contacts"][0] = {"law": "Hysteretic", "stiffness": 2500.0, "restitution": 0.8}
    drop["balls"][0]["name"] = 'it\'s a "ball"\n'
    lines = post(server, "export/python", drop=drop).text
    monkeypatch.chdir(tmp_path)
    found = {}
    exec(lines, found)
    assert found["drop"] == sb.Drop.from_mapping(drop)
    assert (tmp_path / "bounce.svg").stat().st_size > 10_000
    assert "rebound ratios" in capsys.readouterr().out


def test_errors_of_numbers_are_exported(server, drop, tmp_path, monkeypatch):
    errors = {"balls.1.mass": "0.5 g", "contacts.0.stiffness": 100.0}
    monkeypatch.chdir(tmp_path)
    found = {}
    exec(post(server, "export/python", drop=drop, errors=errors).text, found)
    exact = sb.predict(
        sb.Drop.from_mapping(drop),
        {"balls.1.mass": "57 ± 0.5 g", "contacts.0.stiffness": (2500.0, 100.0)},
    )
    assert found["result"].errors.keys() == exact.errors.keys()
    assert str(found["result"].rebound_ratios) == str(exact.rebound_ratios)
    scenario = post(server, "export/toml", drop=drop, errors=errors).text
    assert 'mass = "0.057 ± 0.0005 kg"' in scenario
    assert 'stiffness = "2500.0 ± 100.0 N/m"' in scenario
    wrong = post(server, "export/python", drop=drop, errors={"balls.1.mass": "-1 g"})
    assert wrong.json()["detail"] == "balls.1.mass's error must be 0 or above, got -0.001"


def record(drop, noise=0.3):
    """Return a force record of both contacts, as CSV, its clock 0.5 s late."""
    result = library(drop)
    times = np.arange(-0.02, 0.08, 1e-4)
    forces = result.sample(np.maximum(times, 0.0)).force.values * (times > 0.0)
    forces += np.random.default_rng(1).normal(0.0, noise, forces.shape)
    rows = [f"{t + 0.5:.5f},{a:.3f},{b:.3f}" for t, a, b in zip(times, *forces, strict=True)]
    return "\n".join(["Time (s),Force (N),Force 2 (N)", *rows]).encode()


def test_a_record_is_recognised_and_fitted(server, drop):
    file = {"file": ("force.csv", record(drop))}
    seen = server.post("/api/measure", files=file, data={"options": '{"mass": "150 g"}'})
    assert seen.status_code == 200, seen.text
    seen = seen.json()
    assert seen["holds"] == "waveform"
    assert seen["zero"] == pytest.approx(0.5, abs=2e-4)
    assert seen["measured"] == {"force.0": "force", "force.1": "force_2"}
    assert [curve["what"] for curve in seen["series"]] == ["force", "force"]
    drop["contacts"][1]["stiffness"] = 1300.0
    asked = {
        "drop": json.dumps(drop),
        "vary": '["contacts.0.stiffness", "contacts.1.stiffness"]',
        "measured": json.dumps(seen["measured"]),
    }
    found = server.post("/api/fit", files=file, data=asked)
    assert found.status_code == 200, found.text
    found = found.json()
    for value, true in zip(found["values"], (2500.0, 1000.0), strict=False):
        assert abs(value["value"] - true) < 4 * value["error"]
    assert 0.8 < found["chi_squared"] / found["degrees_of_freedom"] < 1.2
    assert found["series"][1]["time"][0] == pytest.approx(-0.02, abs=2e-4)


def test_typed_numbers_are_fitted(server, drop):
    asked = {
        "drop": json.dumps(drop),
        "vary": '["contacts.1.stiffness"]',
        "measured": '{"rebound_ratios.1": "1.64 ± 0.02"}',
    }
    found = server.post("/api/fit", data=asked).json()
    expected = sb.fit(
        sb.Drop.from_mapping(drop), {"rebound_ratios.1": "1.64 ± 0.02"}, ["contacts.1.stiffness"]
    )
    assert found["values"][0]["value"] == expected["contacts.1.stiffness"].nominal_value
    assert found["residuals"][0]["name"] == "rebound_ratios.1"


WAV = (
    b"RIFF\xa4\x9c\x00\x00WAVEfmt \x10\x00\x00\x00\x01\x00\x01\x00"
    + struct.pack("<IIHH4sI", 1, 2, 2, 16, b"data", 40_000)
    + np.random.default_rng(1).integers(-9000, 9000, 20_000).astype("<i2").tobytes()
)
TRACK = (files("stackbounce.explorer") / "static" / "examples" / "two-tracks.csv").read_bytes()
FORCE = b"Time (s),Force (N)\n" + b"".join(b"%d,0.1\n" % i for i in range(40))


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize(
    ("content", "asked", "message"),
    [
        (b"", {}, "a.csv is empty"),
        (b"\x00" * 100, {}, "a.csv"),
        (b"PK\x03\x04nonsense", {}, "a.csv"),
        (b"%PDF-1.7", {}, "it is a PDF document"),
        (
            b"time (s),force (N)\n" + b"".join(b"%de-320,%d\n" % (i, i % 7) for i in range(60)),
            {},
            "",
        ),
        (WAV, {}, "a.csv"),
        (TRACK, {"options": '{"gravity": 1e-320}'}, "a.csv"),
        (FORCE, {"options": "3"}, "options must be an object in JSON, got '3'"),
        (FORCE, {"options": "["}, "options must be JSON, got '['"),
        (FORCE, {"options": '{"mass": ' + "[" * 500 + "]" * 500 + "}"}, "JSON of at most 8 levels"),
        (FORCE, {"options": '{"path": "/etc/passwd"}'}, "'path' is no option"),
        (FORCE, {"options": '{"mass": "57 m"}'}, "“Ball's mass” must be a mass"),
        (FORCE, {"options": '{"law": "sprung"}'}, "did you mean Spring?"),
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
        ({"vary": "3"}, "vary must be a list of paths, got '3'"),
        ({"vary": "[]"}, "vary must have from 1 to 6 paths, got 0"),
        ({"drop": "{"}, "drop must be JSON, got '{'"),
        ({"measured": '{"force.0": "force"}'}, "force.0 needs a file with a force over time"),
        ({"measured": '{"rebound_ratios.0": 1}'}, "measured must have texts such as '1.64 ± 0.02'"),
        ({"measured": '{"collisions.0": "%s"}' % ("9" * 5000)}, "collisions.0"),
        ({"measured": '{"\\ud800": "1"}'}, "?"),
        ({"measured": "{}"}, "measured must name what was measured, such as"),
    ],
)
def test_a_fit_that_is_none(server, drop, asked, message):
    whole = {"drop": json.dumps(drop), "vary": '["gaps.0"]'} | asked
    response = server.post("/api/fit", data=whole)
    assert response.status_code == 422
    assert message in response.json()["detail"]
