"""What a call says when it is refused."""

import pytest


def refusal(error, make, *given, **named):
    """Return the message of an error that a call has to end with, which is one line."""
    with pytest.raises(error) as caught:
        make(*given, **named)
    assert "\n" not in str(caught.value)
    return str(caught.value)
