"""How much work a call is, in numbers that are the same on every machine."""

import sys
import tracemalloc


def calls_of(function, *given, **options):
    """Return the result of a call and how many functions it called in turn."""
    count = 0

    def seen(_frame, event, _what):
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(seen)
    try:
        result = function(*given, **options)
    finally:
        sys.setprofile(before)
    return result, count


def memory_of(function, *given, **options):
    """Return the result of a call and the most memory in bytes that it held at once."""
    tracemalloc.start()
    try:
        result = function(*given, **options)
        return result, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
