"""Bits that must not change while the engine is rebuilt, kept as texts that a diff shows.

``make frozen`` computes `fuzz` and `laws` again and compares them with ``fuzz.txt`` and
``laws.txt``; ``python -m frozen --write`` (in ``tests``) writes these anew. A line is a name and
what came of it: a number in full, or the digest of the bits of an array.
"""
