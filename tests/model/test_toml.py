import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from refusals import refusal
from stackbounce import errors
from stackbounce.model import (
    LAWS,
    Ball,
    Dashpot,
    Drop,
    Hertz,
    HuntCrossley,
    Hysteretic,
    PowerLaw,
    Rigid,
    RigidBySpeed,
    Spring,
    Viscoelastic,
)

KNOWN = ", ".join([*LAWS, "none"])

SCENARIO = """
height = "63 cm"
gaps = ["2 mm"]

[[balls]]
name = "basketball"
mass = "150 g"
diameter = "16 cm"

[[balls]]
mass = 0.057

[[contacts]]
law = "Spring"
stiffness = "2.5 kN/m"

[[contacts]]
law = "hysteretic"
stiffness = "1 N/mm"
restitution = "78 %"
"""


@pytest.fixture
def read(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def read_text(text):
        content = text if isinstance(text, bytes) else text.encode()
        (tmp_path / "drop.toml").write_bytes(content)
        return Drop.from_toml("drop.toml")

    return read_text


def test_a_scenario_file(read):
    assert read(SCENARIO) == Drop(
        balls=[Ball(0.150, 0.16, "basketball"), Ball(0.057)],
        contacts=[Spring(2500.0), Hysteretic(1000.0, restitution=0.78)],
        gaps=[0.002],
        height=0.63,
    )


def test_a_byte_order_mark_is_passed_over(read):
    assert read(b"\xef\xbb\xbf" + SCENARIO.encode()) == read(SCENARIO)


numbers = st.floats(min_value=1e-300, max_value=1e300)
moderate = st.floats(min_value=1e-100, max_value=1e100)
laws = st.one_of(
    st.builds(Spring, numbers),
    st.builds(Hysteretic, numbers, exponent=st.floats(1.0, 5.0), restitution=st.floats(0.01, 1.0)),
    st.builds(Hysteretic, numbers, unloading_exponent=st.floats(1.0, 50.0)),
    st.builds(Hertz, numbers),
    st.builds(PowerLaw, numbers, st.floats(1.0, 1e6)),
    st.builds(Dashpot, numbers, numbers | st.just(0.0)),
    st.builds(Viscoelastic, numbers, numbers | st.just(0.0)),
    st.builds(HuntCrossley, numbers, st.floats(1.0, 1e6), numbers | st.just(0.0)),
)
shares = st.floats(0.0, 1.0)
by_speed = st.builds(
    RigidBySpeed, st.floats(0.01, 1.0), st.floats(1e-9, 1e9), scatter=shares, seed=shares
)
rigid_laws = st.builds(Rigid, shares) | by_speed
texts = st.text(st.characters(exclude_categories=["Cs"]), min_size=1).filter(str.strip)
ratios = st.floats(-1.0, 0.5, exclude_min=True)
optional = [st.none() | one for one in (numbers, texts, numbers, ratios)]
all_balls = st.builds(Ball, numbers, *optional)


@st.composite
def drops(draw):
    count = draw(st.integers(1, 4))
    law = draw(st.sampled_from([laws, rigid_laws]))
    velocities = st.lists(numbers, min_size=count, max_size=count)
    ways = {"impact_speed": numbers, "height": moderate, "velocities": velocities}
    way = draw(st.sampled_from(sorted(ways)))
    return Drop(
        balls=[draw(all_balls) for _ in range(count)],
        contacts=[draw(law | st.none()), *(draw(law) for _ in range(count - 1))],
        gaps=[draw(numbers | st.just(0.0)) for _ in range(count - 1)],
        gravity=draw(moderate | st.just(0.0)),
        **{way: draw(ways[way])},
    )


@given(drops())
def test_toml_and_mappings_are_read_back_exactly(tmp_path_factory, drop):
    path = tmp_path_factory.mktemp("round") / "drop.toml"
    path.write_text(drop.to_toml(), encoding="utf-8", newline="")
    assert Drop.from_toml(path) == drop
    assert repr(Drop.from_toml(path)) == repr(drop)
    assert Drop.from_mapping(json.loads(json.dumps(drop.to_mapping()))) == drop


def test_null_stands_for_a_key_left_out():
    plain = Drop([Ball(1.0)], [Spring(1.0)], impact_speed=1.0).to_mapping()
    assert Drop.from_mapping(plain | {"height": None, "velocities": None}).impact_speed == 1.0


MASS = 'a mass (a number of kg or a string such as "150 g")'
LENGTH = 'a length (a number of m or a string such as "58 mm")'


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('"150 g"', "-0.15", "balls.0.mass must be a positive number of kilograms, got -0.15"),
        ('"150 g"', '"-150 g"', "balls.0.mass must be a positive number of kilograms, got -0.15"),
        ("0.057", '"0.057 m"', f"balls.1.mass must be {MASS}, got '0.057 m'"),
        ("0.057", "nan", "balls.1.mass must be a finite number of kg, got nan"),
        ("0.057", "true", f"balls.1.mass must be {MASS}, got True"),
        ("0.057", "[1.0]", "balls.1.mass must be a positive number of kilograms, got [1.0]"),
        ("mass = 0.057", "", "balls.1.mass is missing"),
        ("mass = 0.057", "mas = 0.057", "balls.1.mas is not a known key; did you mean mass?"),
        ('"basketball"', "3", "balls.0.name must be a string, got 3"),
        ('"63 cm"', '"3 kg"', f"height must be {LENGTH}, got '3 kg'"),
        ("height", "hight", "hight is not a known key; did you mean height? Known: balls"),
        ('["2 mm"]', '["2 s"]', f"gaps.0 must be {LENGTH}, got '2 s'"),
        ('["2 mm"]', '"2 mm"', "gaps must be a list, got 0.002"),
        ('"Spring"', '"Sprong"', "contacts.0.law must be a contact law, got 'Sprong'; did you"),
        ('"Spring"', "3", f"contacts.0.law must be a contact law, got 3; known: {KNOWN}"),
        ('law = "Spring"', "", f"contacts.0.law is missing; known: {KNOWN}"),
        ('stiffness = "2.5 kN/m"', "", "contacts.0.stiffness is missing"),
        ('"2.5 kN/m"', '"2.5 kN"', "contacts.0.stiffness must be a stiffness (a number of N/m or"),
        ("restitution", "resitution", "contacts.1.resitution is not a known key; did you mean"),
        ('"78 %"', "1.5", "contacts.1.restitution must be a number above 0 and at most 1, got 1.5"),
        ('= "Spring"', '= "none"', "contacts.0.law = \"none\" has no numbers, got {'stiffness': "),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_path(read, old, new, expected):
    assert SCENARIO.count(old) >= 1
    got = refusal(errors.ScenarioError, read, SCENARIO.replace(old, new, 1))
    assert got.startswith(f"drop.toml: {expected}")


def test_the_unit_of_a_stiffness_follows_the_exponent(read):
    text = SCENARIO.replace('restitution = "78 %"', "restitution = 0.78\nexponent = 1.5")
    assert read(text.replace("1 N/mm", "1 N/m^1.5")).contacts[1].stiffness == 1.0
    got = refusal(errors.ScenarioError, read, text)
    assert got.startswith(
        "drop.toml: contacts.1.stiffness must be a quantity (a number of N/m**1.5"
    )


def test_both_numbers_of_a_hysteretic_contact_are_read_where_they_agree(read):
    text = SCENARIO.replace('"78 %"', "0.5\nunloading_exponent = 7")
    assert read(text).contacts[1] == Hysteretic(1000.0, restitution=0.5)
    got = refusal(errors.ScenarioError, read, text.replace("= 7", "= 8"))
    assert got.startswith("drop.toml: contacts.1.restitution and unloading_exponent: exactly one")


@pytest.mark.parametrize(
    ("mapping", "expected"),
    [
        (3, "the scenario must be a table of keys and values, got 3"),
        ({}, "balls is missing"),
        ({"balls": 3, "contacts": []}, "balls must be a list of tables, got 3"),
        ({"balls": [3], "contacts": []}, "balls.0 must be a table of keys and values, got 3"),
        ({"balls": []}, "contacts is missing"),
    ],
)
def test_mappings_of_another_shape(mapping, expected):
    assert refusal(errors.ScenarioError, Drop.from_mapping, mapping) == expected


def test_a_key_cannot_break_the_line(read):
    got = refusal(errors.ScenarioError, read, '"a\\nb\\u001b" = 1\n' + SCENARIO)
    assert got.startswith(r"drop.toml: 'a\nb\x1b' is not a known key; known: balls, contacts")


def test_texts_and_lists_may_have_many_dots(read):
    numbers = ", ".join(["0.5"] * 100)
    got = refusal(errors.ScenarioError, read, f"name = 'a. b. c. d. e. f. g'\ngaps = [{numbers}]")
    assert got == "drop.toml: name is not a known key; " + got.partition("; ")[2]


NESTED, MANY = "[" * 5000, "a key has more than 5 parts between dots"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"\xff\xfe\x00a", " is not TOML: it is not text in UTF-8"),
        *((text, " is not TOML: ") for text in ("[[balls]", "a = 1\na = 2", f"a = {NESTED}")),
        ("a = " + "9" * 5000, " is not TOML: "),
        ("a" + ".a" * 50_000 + " = 1", f": {MANY}"),
        ("[" + "a." * 50_000 + "a]", f": {MANY}"),
        ("'a'" + ' . "a"' * 50_000 + " = 1", f": {MANY}"),
        ("x = {" + "a." * 50_000 + "a = 1}", f": {MANY}"),
    ],
)
def test_what_is_no_toml_or_has_keys_of_many_parts_is_refused(read, content, said):
    assert refusal(errors.ScenarioError, read, content).startswith(f"drop.toml{said}")


def test_a_file_too_large_is_not_read(tmp_path):
    path = tmp_path / "large.toml"
    path.write_bytes(b"#" * (2**19 + 1))
    assert "is larger than 512 KiB" in refusal(errors.FileError, Drop.from_toml, path)


def test_a_path_in_bytes_of_an_object_is_refused():
    class InBytes:
        def __fspath__(self):
            return b"drop.toml"

    assert refusal(errors.InvalidType, Drop.from_toml, InBytes()).startswith("path must be a str")


@pytest.mark.parametrize(
    ("text", "law"),
    [
        ('law = "hertz"\nstiffness = "1 N/mm^1.5"', Hertz(1000.0**1.5)),
        ('law = "PowerLaw"\nstiffness = "2 kN/m^1.3"\nexponent = 1.3', PowerLaw(2000.0, 1.3)),
        ('law = "dashpot"\nstiffness = "20 kN/m"\ndamping = "7 N s/m"', Dashpot(2e4, 7.0)),
        (
            'law = "Viscoelastic"\nstiffness = 3e6\ndissipative_time = "0.2 ms"',
            Viscoelastic(3e6, 2e-4),
        ),
        (
            'law = "HuntCrossley"\nstiffness = "3 N/m^2"\nexponent = 2\ndissipation = "2 ms/cm"',
            HuntCrossley(3.0, 2.0, 0.2),
        ),
    ],
)
def test_each_law_reads_its_units(read, text, law):
    got = read(SCENARIO[: SCENARIO.rindex("law = ")] + text).contacts[1]
    assert type(got) is type(law)
    assert vars(got) == pytest.approx(vars(law), rel=1e-15)


def test_a_balls_material_has_units(read):
    text = SCENARIO.replace("mass = 0.057", 'mass = 0.057\nyoung_modulus = "206 GPa"')
    ball = read(text.replace("206 GPa", '206 GPa"\npoisson_ratio = "30 %')).balls[1]
    assert ball == Ball(0.057, young_modulus=206e9, poisson_ratio=0.3)
    got = refusal(errors.ScenarioError, read, text.replace("GPa", "kN"))
    assert got.startswith("drop.toml: balls.1.young_modulus must be a pressure (a number of Pa or")
