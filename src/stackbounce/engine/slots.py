"""The slots of a stack's two small arrays, `number` and `counter`: one meaning per name.

`Stack` and `RigidStack` have the same slots; each leaves those of the other at 0.
"""

# `number`: floats that hold for the whole stack, in its own units
GRAVITY = 0
SPEED = 1  # the reference speed: the largest speed at the start
TOLERANCE = 2  # finite contacts: the velocity error allowed in one step, over SPEED
LINEARISED_WORK = 3  # finite: work below which a chord replaces c^p, over that of a contact
UNIT = 4  # rigid balls: the factor from velocities and gaps in the arrays to SI units
KEPT_TIME = 5  # rigid: time of the reference state, see `collapse.keep_state`
LAST_EVENT = 6  # time of the last event
LAST_CHECK = 7  # finite: time of the last event or check; 0 for rigid balls
NUMBERS = 8

# `counter`: integers that hold for the whole stack
LOG_ROWS = 0  # rows in the log
EVENTS = 1  # since the start
CHECKS = 2  # finite: contacts checked and series renewed since the last event
NEXT_SAMPLE = 3  # the index of the next sample time
CLOSED = 4  # finite: contacts that are not open
APPROACHING = 5  # finite: a contact that was approaching when all were last checked
STEPS = 6  # finite: events and checks since the start
STEPS_BEFORE = 7  # finite: those up to the last touch or release
WORK = 8  # what the run has cost since the start, in the unit of `work`
CAUSE = 9  # why the run met a limit, see `codes`
# finite contacts only: what a run does not change
SERIES_ORDER = 10  # of the power series of nonlinear clusters
NONLINEAR = 11  # 1 where some contact can be nonlinear
RECORDS_PEAKS = 12  # 1 if peak forces, peak compressions and impulses are recorded
BONDS = 13  # number of contacts that never open
# rigid balls only: those at rest, and the search for repeated states (`collapse`)
BALLS_AT_REST = 14  # on the floor, the lowest ones
LOWEST_LOSSY = 15  # the lowest contact that loses energy; the number of balls if there is none
KEPT_CONTACT = 16  # the contact that had just collided in the reference state
KEEP_AFTER = 17  # number of collisions after which the reference state is replaced
SINCE_KEPT = 18  # number of collisions since the reference state
LOWEST_INVOLVED = 19  # lowest and highest contact that have collided since then
HIGHEST_INVOLVED = 20
COUNTERS = 21
