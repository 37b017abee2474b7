"""A priority queue of times: an indexed binary heap; of equal times the lowest slot comes first.

``due[slot]`` is a slot's time, ``heap`` lists the slots in heap order, and ``place[slot]`` is the
index of a slot in it. The earliest slot is always ``heap[0]``.
"""

import math

from stackbounce.engine.kernels import Floats, Integers, kernel


@kernel
def clear_queue(due: Floats, heap: Integers, place: Integers) -> None:
    """Set the times of all slots to infinity: nothing is due."""
    for slot in range(len(due)):
        due[slot] = math.inf
        heap[slot] = slot
        place[slot] = slot


@kernel
def schedule(due: Floats, heap: Integers, place: Integers, slot: int, time: float) -> None:
    """Set the time at which a slot is due."""
    if due[slot] == time:
        return
    due[slot] = time
    at = place[slot]
    while at > 0:
        parent = (at - 1) // 2
        other = heap[parent]
        if due[other] < time or (due[other] == time and other < slot):
            break
        heap[at] = other
        place[other] = at
        at = parent
    size = len(heap)
    while 2 * at + 1 < size:
        child = 2 * at + 1
        other = heap[child]
        if child + 1 < size:
            right = heap[child + 1]
            if due[right] < due[other] or (due[right] == due[other] and right < other):
                child += 1
                other = right
        if time < due[other] or (time == due[other] and slot < other):
            break
        heap[at] = other
        place[other] = at
        at = child
    heap[at] = slot
    place[slot] = at
