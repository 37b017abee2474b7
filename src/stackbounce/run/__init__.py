"""Run drops: one module chooses the engine, and compiled code or plain Python, for all of them.

============ ===========================================================================
options      the end time, the tolerance and the event limit of a run
engines      chooses the engine, and plain Python or compiled code
driver       one drop: `simulate`
batch        many drops in blocks, into which a grid is cut, and threads
bounces      one ball that bounces on in air
collision    one collision: restitution and contact time, and drops by separate collisions
conditioning how far an error of the numbers of a drop grows
calibration  the law that has a restitution and a contact time
quantities   speeds, heights, times and energy of many drops, by name
result       the `Result` of one drop
sideways     how balls leave sideways that do not stand exactly above each other
paths        the parameters of a drop by their paths, and of many drops as arrays
============ ===========================================================================
"""
