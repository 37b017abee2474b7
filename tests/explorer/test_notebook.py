"""What `explore` refuses before it shows anything."""

import pytest

import stackbounce as sb

BALL, SPRING = sb.Ball(0.1), sb.Spring(1e4)


@pytest.mark.parametrize(
    ("drop", "words"),
    [
        (sb.Drop([BALL] * 7, [SPRING] * 7, height=1.0), "balls must be at most 6 .* got 7"),
        (
            sb.Drop([BALL] * 2, [SPRING, sb.Bond(1e4, 0.1)], height=1.0),
            "contacts.1 must be a law that the explorer has, got Bond",
        ),
        ("basketball", "drop must be a Drop, got 'basketball'"),
    ],
)
def test_what_the_page_cannot_show_is_refused(drop, words):
    with pytest.raises(sb.StackbounceError, match=f"^{words}"):
        sb.explore(drop)
