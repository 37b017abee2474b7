"""The event queue gives the earliest slot, the lowest of equal ones, after any changes."""

from random import Random

import pytest

from stackbounce.engine.event_queue import clear_queue, schedule


@pytest.mark.parametrize("size", [1, 2, 3, 10, 33])
def test_the_earliest_slot_comes_first(size):
    random = Random(size)
    due, heap, place = [0.0] * size, [0] * size, [0] * size
    clear_queue(due, heap, place)
    times = [float("inf")] * size
    for _ in range(500):
        slot = random.randrange(size)
        times[slot] = random.choice([float("inf"), *map(float, range(8))])
        schedule(due, heap, place, slot, times[slot])
        assert heap[0] == min(range(size), key=lambda s: (times[s], s))
        assert due == times
        assert [heap[place[s]] for s in range(size)] == list(range(size))
