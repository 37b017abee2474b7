import math
import pickle

import numpy as np
import pytest

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


@pytest.mark.parametrize("value", [True, np.True_, "2", b"2", None, 2j, [2.0], np.array([2.0])])
def test_what_is_no_number_is_refused(value):
    for check in (errors.finite, errors.positive, errors.non_negative, errors.fraction):
        with pytest.raises(errors.InvalidType, match=r"^mass must be a .*number.*, got ") as caught:
            check("mass", value)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 10**400])
def test_what_is_not_finite_is_refused(value):
    for check in (errors.finite, errors.positive, errors.non_negative, errors.fraction):
        with pytest.raises(errors.InvalidValue, match=r"^mass must be a"):
            check("mass", value)


@pytest.mark.parametrize(
    ("check", "value", "message"),
    [
        (errors.positive, 0, "mass must be a positive number, got 0"),
        (errors.positive, -0.057, "mass must be a positive number, got -0.057"),
        (errors.positive, math.nan, "mass must be a positive number, got nan"),
        (errors.finite, math.inf, "mass must be a finite number, got inf"),
        (errors.non_negative, -1, "mass must be a number, 0 or above, got -1"),
        (errors.fraction, 1.1, "mass must be a number from 0 to 1, got 1.1"),
        (errors.fraction, -0.1, "mass must be a number from 0 to 1, got -0.1"),
    ],
)
def test_message_says_what_was_wrong_what_was_got_and_what_would_be_right(check, value, message):
    with pytest.raises(errors.InvalidValue) as caught:
        check("mass", value)
    assert str(caught.value) == message


def test_unit_in_words_enters_the_message():
    with pytest.raises(errors.InvalidValue) as caught:
        errors.positive("mass", np.float64(-1), "kilograms")
    assert str(caught.value) == "mass must be a positive number of kilograms, got -1.0"


def test_fraction_without_zero():
    assert errors.fraction("e", 0) == 0.0
    with pytest.raises(errors.InvalidValue, match="above 0 and at most 1, got 0"):
        errors.fraction("e", 0, zero=False)


@pytest.mark.parametrize(("high", "range_"), [(2.0, " from 1 to 2"), (math.inf, ", 1 or above")])
def test_between(high, range_):
    assert errors.between("p", 1, 1.0, high) == 1.0
    with pytest.raises(errors.InvalidValue) as caught:
        errors.between("p", 0.5, 1.0, high)
    assert str(caught.value) == f"p must be a number{range_}, got 0.5"


def test_whole_numbers():
    assert errors.whole("limit", np.int64(3), 1) == 3
    with pytest.raises(
        errors.InvalidValue, match="limit must be a whole number, 1 or above, got 0"
    ):
        errors.whole("limit", 0, 1)
    for value in (2.0, "2", True, None):
        with pytest.raises(errors.InvalidType, match="limit must be a whole number, 1 or above"):
            errors.whole("limit", value, 1)


def test_whole_numbers_in_a_range():
    assert errors.whole("limit", 10, 1, 10) == 10
    with pytest.raises(errors.InvalidValue, match=r"limit must be .* from 1 to 1e\+18, got 18446"):
        errors.whole("limit", 2**64, 1, 10**18)
    with pytest.raises(errors.InvalidValue, match=r"got <unprintable int object>$"):
        errors.whole("limit", 10**5000, 1, 10**18)


@pytest.mark.parametrize("value", [np.timedelta64(3, "s"), np.timedelta64(3)])
def test_a_time_of_numpy_is_no_number(value):
    for check in (errors.finite, errors.whole):
        with pytest.raises(errors.InvalidType, match=r"must be a .* number.*, got np.timedelta64"):
            check("mass", value)


def test_nearest_name():
    assert (
        errors.nearest("sprng", ["Rigid", "Spring"]) == "did you mean Spring? Known: Rigid, Spring"
    )
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
