import math
import pickle
import re
from functools import partial

import numpy as np
import pytest

from refusals import refusal
from stackbounce import errors


@pytest.mark.parametrize(
    ("error", "builtin"),
    [
        (errors.InvalidValue, ValueError),
        (errors.InvalidType, TypeError),
        (errors.UnitError, ValueError),
        (errors.ScenarioError, ValueError),
        (errors.FileError, OSError),
    ],
)
def test_each_exception_is_ours_and_a_builtin_one(error, builtin):
    assert issubclass(error, errors.StackbounceError)
    assert issubclass(error, builtin)
    assert str(pickle.loads(pickle.dumps(error("one line")))) == "one line"


@pytest.mark.parametrize("value", [2, 2.0, np.float64(2), np.float32(2), np.int32(2)])
def test_numbers_of_every_kind_become_floats(value):
    for check in (errors.finite, errors.positive, errors.non_negative):
        got = check("mass", value)
        assert got == 2.0
        assert type(got) is float


@pytest.mark.parametrize(
    "value", [True, np.True_, "2", b"2", None, 2j, [2.0], np.array([2.0]), np.timedelta64(3, "s")]
)
def test_what_is_no_number_is_refused(value):
    for check in (errors.finite, errors.positive, errors.non_negative, errors.fraction):
        said = refusal(errors.InvalidType, check, "mass", value)
        assert re.match(r"mass must be a .*number.*, got ", said)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 10**400])
def test_what_is_not_finite_is_refused(value):
    for check in (errors.finite, errors.positive, errors.non_negative, errors.fraction):
        with pytest.raises(errors.InvalidValue, match=r"^mass must be a"):
            check("mass", value)


@pytest.mark.parametrize(
    ("check", "value", "message"),
    [
        (errors.positive, 0, "a positive number, got 0"),
        (errors.positive, -0.057, "a positive number, got -0.057"),
        (errors.finite, math.inf, "a finite number, got inf"),
        (errors.non_negative, -1, "a number, 0 or above, got -1"),
        (errors.fraction, 1.1, "a number from 0 to 1, got 1.1"),
        (partial(errors.fraction, zero=False), 0, "a number above 0 and at most 1, got 0"),
        (partial(errors.positive, of="kilograms"), -1.0, "a positive number of kilograms, got"),
        (partial(errors.between, low=1.0, high=2.0), 0.5, "a number from 1 to 2, got 0.5"),
        (partial(errors.between, low=1.0, high=math.inf), 0.5, "a number, 1 or above, got 0.5"),
        (partial(errors.whole, low=1), 0, "a whole number, 1 or above, got 0"),
        (partial(errors.whole, low=1, high=9), 2**64, "a whole number from 1 to 9, got 18446744"),
    ],
)
def test_message_says_what_was_wrong_what_was_got_and_what_would_be_right(check, value, message):
    assert refusal(errors.InvalidValue, check, "mass", value).startswith(f"mass must be {message}")


def test_ends_of_ranges_are_in_them():
    assert errors.fraction("e", 0) == 0.0
    assert errors.between("p", 1, 1.0, 2.0) == 1.0
    assert errors.whole("limit", np.int64(3), 3) == errors.whole("limit", 3, 1, 3) == 3


@pytest.mark.parametrize("value", [2.0, "2", True, None, np.timedelta64(3)])
def test_what_is_no_whole_number_is_refused(value):
    with pytest.raises(errors.InvalidType, match="limit must be a whole number, 1 or above"):
        errors.whole("limit", value, 1)


def test_nearest_name():
    near = errors.nearest("sprng", ["Rigid", "Spring"])
    assert near == "did you mean Spring? Known: Rigid, Spring"
    assert errors.nearest("xyz", ["Rigid", "Spring"]) == "known: Rigid, Spring"


def test_long_values_are_cut_to_one_line():
    assert errors.shown("a\nb") == "'a\\nb'"
    assert len(errors.shown("x" * 1000)) == 60
    assert "\n" not in errors.shown(np.zeros((4, 4)))


class Unprintable:
    def __repr__(self):
        raise RuntimeError("no text")


@pytest.mark.parametrize(
    "value",
    [10**400, 10**5000, -(10**5000), Unprintable(), [Unprintable()], {"a": 10**5000}],
    ids=lambda value: type(value).__name__,
)
def test_no_value_breaks_a_message(value):
    assert 0 < len(errors.shown(value)) <= 60
    with pytest.raises(errors.StackbounceError, match=r"^mass must be a positive number, got "):
        errors.positive("mass", value)
    assert errors.nearest(value, ["Rigid", "Spring"]) == "known: Rigid, Spring"


def test_what_cannot_be_shown_says_its_type():
    assert errors.shown(10**5000) == "<unprintable int object>"
    assert errors.shown(Unprintable()) == "<unprintable Unprintable object>"
