"""The film of a drop: how long it is, where the balls are in it, and what it says."""

import numpy as np
import pytest

from explorer.page.asking import run_node
from stackbounce.cross2007.cases import list_cases
from stackbounce.model import STANDARD_GRAVITY

_PICTURE = 500.0  # px, as ask_film.mjs has it

FIRST = {
    "balls": [
        {"mass": 0.15, "diameter": 0.16, "name": "basketball"},
        {"mass": 0.057, "diameter": 0.066, "name": "tennis"},
    ],
    "contacts": [{"law": "Spring", "stiffness": 2500}, {"law": "Spring", "stiffness": 1000}],
    "gaps": [0],
    "impact_speed": 3.53,
    "gravity": 0,
}


def changed(drop=FIRST, **values):
    new = {**drop, **values}
    if "velocities" in values:
        del new["impact_speed"]
    return new


def tower(masses, law, gaps=None, **values):
    stack = {"balls": [{"mass": mass} for mass in masses], "contacts": [law] * len(masses)}
    gaps = gaps or [0] * (len(masses) - 1)
    return stack | {"gaps": gaps, "impact_speed": 3, "gravity": 0} | values


STIFF = {"law": "Spring", "stiffness": 50_000}
NONE = {"law": "none"}
DROPS = {
    "first": FIRST,
    "a large gap": changed(gaps=[0.2]),
    "gravity": changed(gravity=STANDARD_GRAVITY),
    "a large gap and gravity": changed(gaps=[0.2], gravity=STANDARD_GRAVITY),
    "fast": changed(impact_speed=30),
    "slow": changed(impact_speed=0.02),
    "no floor": changed(contacts=[NONE, STIFF]),
    "no floor, towards one another": changed(contacts=[NONE, STIFF], velocities=[1, -1]),
    "no floor, both down": changed(contacts=[NONE, STIFF], velocities=[-0.5, -2]),
    "apart": changed(velocities=[1, 2]),
    "the lower one alone": changed(velocities=[-3, 0]),
    "the upper one alone": changed(velocities=[0, -3]),
    "thrown up from below": changed(velocities=[1, -3], gaps=[0.1]),
    "one ball": tower([0.1], STIFF),
    "one ball that stays": tower([0.1], {"law": "Rigid", "restitution": 0}),
    "six balls": tower([2 / 3**i for i in range(6)], STIFF),
    "six rigid balls": tower([2 / 3**i for i in range(6)], {"law": "Rigid", "restitution": 0.9}),
    "rigid, often": tower([0.1, 0.1, 0.1], {"law": "Rigid", "restitution": 0.2}, [1e-3, 2e-3]),
    "equal balls": tower([0.1, 0.1], {"law": "Spring", "stiffness": 2000}),
    "a heavy ball on top": tower([0.01, 0.5], STIFF),
    "rest": changed(
        gravity=STANDARD_GRAVITY,
        contacts=[{"law": "Dashpot", "stiffness": 2500, "damping": 60}] * 2,
    ),
} | {one.name: one.drop.to_mapping() for one in list_cases()}


@pytest.fixture(scope="module")
def shown_of(page, tmp_path_factory):
    """Return a function that asks the page for the films of some drops."""
    folder = tmp_path_factory.mktemp("films")
    return lambda drops, events=100_000: run_node("ask_film", page, drops, folder, events)


@pytest.fixture(scope="module")
def films(shown_of):
    found = dict(zip(DROPS, shown_of([[drop, None] for drop in DROPS.values()]), strict=True))
    assert not [name for name in found if "error" in found[name]]
    return found


@pytest.fixture(params=DROPS)
def film(request, films):
    return films[request.param]["film"]


def column(film, name):
    return np.array([one[name] for one in film["shown"]])


def test_a_film_lasts_at_most_fifteen_seconds_and_goes_forward(film):
    assert 0.1 < film["length"] <= 15.0
    assert (np.diff(column(film, "time")) > 0).all()
    assert np.abs(column(film, "back")).max() < 1e-9
    assert film["same"]


def test_balls_stay_in_the_picture_and_the_camera_moves_without_jumps(film):
    assert column(film, "top").max() <= _PICTURE + 1e-6
    assert column(film, "bottom").min() >= -1e-6
    nearness = np.log(column(film, "scale"))
    steps = np.abs(np.diff(nearness))  # 400 of them; the camera takes 0.9 s from far to near
    assert steps.max() <= 0.1 * np.ptp(nearness) + 1e-9


@pytest.mark.parametrize("name", DROPS)
def test_balls_never_pass_through_each_other_or_the_floor(films, name):
    film = films[name]["film"]
    position = column(film, "position")
    pressed = np.maximum(column(film, "compression"), 0.0)
    assert (np.diff(position, axis=1) + pressed[:, 1:]).min(initial=0.0) >= -1e-9
    if DROPS[name]["contacts"][0]["law"] != "none":
        assert (position[:, 0] + pressed[:, 0]).min() >= -1e-9
    ghosts = [one["ghosts"] for one in film["shown"] if one["ghosts"] is not None]
    assert np.diff(ghosts or [[0.0]], axis=1).min(initial=0.0) >= -1e-9


def test_balls_move_without_jumps(film):
    """Between two moments no ball comes further than its velocities allow."""
    time, position, velocity = (column(film, name) for name in ("time", "position", "velocity"))
    step = np.diff(time)[:, None]
    bound = step * (np.abs(velocity).max() + STANDARD_GRAVITY * step + 1e-9)
    assert (np.abs(np.diff(position, axis=0)) <= 1.001 * bound + 1e-9).all()


def test_fall_and_leap_have_real_time_and_the_impact_lasts_some_seconds(films):
    film = films["first"]["film"]
    assert film["begin"] == pytest.approx(-3.53 / STANDARD_GRAVITY, rel=1e-12)
    assert film["shown"][0]["velocity"] == pytest.approx([0.0, 0.0], abs=1e-12)
    time, step = column(film, "time"), film["length"] / 400
    phase = column(film, "phase")
    for name in ("fall", "leap"):
        inside = (phase[1:] == name) & (phase[:-1] == name)
        assert np.diff(time)[inside] == pytest.approx(step, rel=1e-9)
    assert 6.0 <= step * np.isin(phase, ["before", "impact", "between", "after"]).sum() <= 8.0
    assert film["slow"] == 180.0


def test_the_film_stands_at_the_highest_top_and_then_the_ball_falls_back(films):
    film = films["first"]["film"]
    top = film["tops"][1]
    assert top["height"] == pytest.approx(
        films["first"]["speeds"][1] ** 2 / 2 / STANDARD_GRAVITY, rel=0.01
    )
    phase, step = column(film, "phase"), film["length"] / 400
    assert (phase == "top").sum() * step == pytest.approx(1.0, abs=0.05)
    seen = column(film, "position")[phase == "top"][:, 1]
    assert seen == pytest.approx(np.full(seen.shape, top["height"]), abs=1e-4)
    assert film["shown"][-1]["position"][1] == pytest.approx(0.0, abs=1e-9)
    what = [one["what"] for one in film["events"]]
    assert what == ["begin", "touch", "touch", "parting", "parting", "top", "top", "end"]


def test_a_drop_that_was_stopped_has_no_leap(shown_of):
    [found] = shown_of([[tower([0.1, 0.2, 0.1], STIFF, [1e-3, 2e-3]), None]], events=2)
    assert found["status"] == "EVENT_LIMIT"
    assert "leap" not in column(found["film"], "phase")
    assert found["sentence"]["lead"].startswith("The film ends before the balls have parted")


def test_a_whole_drop_has_real_time(shown_of):
    [found] = shown_of([[changed(gravity=STANDARD_GRAVITY), 1.5]])
    film = found["film"]
    assert film["length"] == pytest.approx(film["end"] - film["begin"])
    assert set(column(film, "phase")) == {"whole"}
    assert found["sentence"]["lead"].startswith("The tennis ball rises to ")


BALL = {"law": "Spring", "stiffness": 9e3}
LOSSY = {"law": "Rigid", "restitution": 0.5}
COLLIDE = "The textbook lets the balls collide one after the other;"
BOTH = f"{COLLIDE} here both contacts push at the same time for"
ALIKE = "The contacts come one after the other, as in the textbook."
NEARLY = ALIKE.replace("come", "come nearly")
UP = "times the speed of the impact"
NAMED = [{"mass": 1, "name": "B1"}, {"mass": 0.2}, {"mass": 0.05, "name": "marble"}]
SENTENCES = {
    "the first drop": (
        FIRST,
        f"""The tennis ball flies up at 1.80 {UP}, nearly the textbook's 1.90. The basketball flies
        up at 0.38 {UP}, 3.7 times as fast as the textbook's 0.10. {BOTH} 90 % of the impact.""",
    ),
    "one ball": (tower([0.1], BALL), "The ball flies up as fast as the drop came in."),
    "one ball with losses": (tower([0.1], LOSSY), f"The ball flies up at 0.50 {UP}."),
    "one ball that stays": (
        tower([0.1], {"law": "Rigid", "restitution": 0}),
        "The ball stands still after the impact.",
    ),
    "rigid balls": (
        tower([0.1, 0.05], LOSSY),
        f"""The upper ball flies up at 0.50 {UP}. These are the textbook's collisions: 3
        of them, one after the other, each in no time.""",
    ),
    "a gap": (
        changed(gaps=[0.2]),
        f"The tennis ball flies up at 1.90 {UP}, as the textbook says. {ALIKE}",
    ),
    "faster and slower than the textbook": (
        tower([0.1, 0.1], STIFF),
        f"""The upper ball flies up at 1.19 {UP}, faster than the textbook's 1.00. The lower ball
        flies up at 0.77 {UP}, slower than the textbook's 1.00. {BOTH} 85 % of the impact.""",
    ),
    "where the textbook's ball stands still": (
        tower([0.3, 0.1], {"law": "Spring", "stiffness": 8e3}),
        f"""The upper ball flies up at 1.28 {UP}, slower than the textbook's 2.00. The lower ball
        flies up at 0.89 {UP}, where the textbook has it stand still. {BOTH} 90 % of the impact.""",
    ),
    "three balls with names": (
        tower([1, 0.2, 0.05], STIFF) | {"balls": NAMED},
        f"""The marble flies up at 1.29 {UP}, slower than the textbook's 4.33. B1 flies up at 0.94
        {UP}, 2.8 times as fast as the textbook's 0.33. {COLLIDE} here several contacts push at the
        same time for 89 % of the impact.""",
    ),
    "contacts that hardly overlap": (
        changed(gaps=[0.085]),
        f"The tennis ball flies up at 1.90 {UP}, as the textbook says. {NEARLY}",
    ),
    "no floor": (
        changed(contacts=[NONE, STIFF], velocities=[1, -1]),
        f"The tennis ball flies up at 1.90 {UP}, as the textbook says. {ALIKE}",
    ),
    "nothing touches": (changed(velocities=[1, 2]), "Nothing touches, so that no speed changes."),
    "balls that come to rest": (DROPS["rest"], "The balls come to rest and do not bounce."),
}


def said_of(found):
    """Return the whole text of a sentence, with straight apostrophes."""
    lead, more = found["sentence"]["lead"], found["sentence"]["more"]
    return f"{lead} {more}".strip().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")


def test_the_sentence_is_true(shown_of):
    found = shown_of([[drop, None] for drop, _ in SENTENCES.values()])
    for (name, (_, said)), one in zip(SENTENCES.items(), found, strict=True):
        assert said_of(one) == " ".join(said.split()), name


def test_no_sentence_says_1_times_or_numbers_a_ball_from_nought(films):
    for found in films.values():
        said = said_of(found)
        assert not any(one in said for one in (" 1 times", "ball 0", "NaN", "undefined"))


def test_a_ball_without_a_name_has_the_same_one_everywhere(page, tmp_path):
    drops = [{"balls": [{}] * count} for count in (1, 2, 6)]
    asks = [
        ["words/words", name, drop, ball]
        for drop, ball in zip(drops, (0, 1, 2), strict=True)
        for name in ("ballName", "shortBall", "contactName", "shortContact")
    ]
    assert run_node("ask_language", page, asks, tmp_path, "en") == [
        *("ball", "ball", "floor – ball", "floor – ball"),
        *("upper ball", "upper ball", "lower ball – upper ball", "lower ball – upper ball"),
        *("ball 3", "3", "ball 2 – ball 3", "2–3"),
    ]


def test_impulses_are_what_momenta_have_gained(page, asked, tmp_path):
    drops = [
        tower([0.3, 0.1], {"law": "Rigid", "restitution": 0.001}, impact_speed=1),
        changed(gravity=STANDARD_GRAVITY, gaps=[0.05]),
    ]
    rigid, soft = (one["answer"] for one in asked([["simulate", drop, None, 20] for drop in drops]))
    asks = [["views/numbers", "impulsesOf", result] for result in (rigid, soft)]
    dead, found = run_node("ask_language", page, asks, tmp_path, "en")
    assert dead == pytest.approx([0.4, 0.1], rel=0.01)
    each = [
        sum(one["impulse"] for one in soft["intervals"] if one["contact"] == contact)
        for contact in (0, 1)
    ]
    assert found == pytest.approx(each, rel=1e-6)


def test_lines_are_told_apart_without_colours(page, asked, tmp_path):
    [found] = asked([["simulate", DROPS["six balls"], None, 20]])
    panels = [["plots/curves", "panels", found["answer"], False]]
    [position, force, energy] = run_node("ask_language", page, panels, tmp_path, "en")[0]
    for panel in (position, force, energy):
        looks = [str(line.get("dash")) for line in panel["lines"] if line["index"] is not None]
        assert len(set(looks)) == len(looks) == 6


def test_a_ball_off_the_middle_leaves_at_its_angle_and_lands_on_the_floor(shown_of):
    """0.24 m away where it lay, by the library; the floor is 0.16 m below that."""
    moved = [FIRST["balls"][0], FIRST["balls"][1] | {"offset": 1e-3}]
    [aside] = shown_of([[changed(balls=moved), None]])
    said, film = aside["sentence"]["more"], aside["film"]
    assert "1 mm to the side: the tennis ball leaves 1.7° off, and lands 0.24 m away. " in said
    time, beside = column(film, "time"), column(film, "sideways")[:, 1]
    flies = (time > film["last"]) & (time < film["end"])
    assert np.diff(beside[flies]) / np.diff(time[flies]) == pytest.approx(0.18399, rel=1e-4)
    assert 0.24 < beside[-1] < 0.25
    assert film["shown"][-1]["position"][1] == pytest.approx(-0.16)


def test_a_track_is_laid_on_the_drop_also_if_it_could_be_laid_beside_it(page, tmp_path):
    times = np.arange(-0.45, 3.0, 1.0 / 30.0)
    heights = np.where(times < 0.0, -times, np.exp(-times) * np.abs(np.sin(4.0 * times))).tolist()
    line, track = ({"time": (times + late).tolist(), "values": heights} for late in (0.0, 0.65))
    asked = {"track": track, "line": line, "reach": 3.0, "until": 1.2}
    assert run_node("ask_shift", page, asked, tmp_path) == pytest.approx(-0.65, abs=0.01)
