"""From drops to results: one choice of engine and mode for one drop and for many.

======== ============================================================================
options  until when to run, to which tolerance, for how many events
columns  a drop's numbers, and those of many drops, as the engine takes them
engines  chooses the engine, and plain Python or compiled code
driver   one drop: `simulate`
batch    many drops in blocks and threads
result   the `Result` of one drop
paths    the numbers of a drop by their paths
blocks   a grid of drops cut into blocks
======== ============================================================================
"""
