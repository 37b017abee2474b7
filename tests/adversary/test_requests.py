"""Generated and hostile requests get an answer in words (`python -m adversary.requests`: more)."""

import asyncio
import tempfile

import pytest

from adversary.requests import attack, judge
from adversary.requests_server import serving

pytestmark = pytest.mark.slow


def test_requests_of_all_kinds_are_answered():
    with tempfile.TemporaryFile("w+") as errors, serving(stderr=errors) as server:
        answers = asyncio.run(attack(server, count=300, seed=18))
        errors.seek(0)
        assert judge(server, errors.read(), answers) == []
    assert len(answers) == 300
