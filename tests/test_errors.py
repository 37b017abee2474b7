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


def test_nearest_name():
    assert (
        errors.nearest("sprng", ["Rigid", "Spring"]) == "did you mean Spring? Known: Rigid, Spring"
    )
    assert errors.nearest("xyz", ["Rigid", "Spring"]) == "known: Rigid, Spring"


def test_long_values_are_cut_to_one_line():
    assert errors.shown("a\nb") == "'a\\nb'"
    assert len(errors.shown("x" * 1000)) == 60
    assert "\n" not in errors.shown(np.zeros((4, 4)))
