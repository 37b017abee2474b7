"""The slots of a stack's small arrays: one meaning per name, the same slot in both records.

========== ============= ============= =================================================
array      `Stack`       `RigidStack`  slots
========== ============= ============= =================================================
`number`   6             6             GRAVITY, SPEED, TOLERANCE, LINEARISED_WORK, UNIT,
                                       KEPT_TIME
`setting`  4                           SERIES_ORDER, NONLINEAR, RECORDS_PEAKS, BONDS
`counter`  10            10            LOG_ROWS, EVENTS, CHECKS, NEXT_SAMPLE, CLOSED,
                                       APPROACHING, STEPS, STEPS_BEFORE, WORK, CAUSE
`clock`    2             2             LAST_EVENT, LAST_CHECK
`resting`                2             BALLS_AT_REST, LOWEST_LOSSY
`memory`                 5             KEPT_CONTACT, KEEP_AFTER, SINCE_KEPT,
                                       LOWEST_INVOLVED, HIGHEST_INVOLVED
========== ============= ============= =================================================
"""

# `number`: floats that hold for the whole stack, in its own units
GRAVITY = 0
SPEED = 1  # the reference speed: the largest speed at the start
TOLERANCE = 2  # finite contacts: the velocity error allowed in one step, over SPEED
LINEARISED_WORK = 3  # finite: work below which a chord replaces c^p, over that of a contact
UNIT = 4  # rigid balls: the factor from velocities and gaps in the arrays to SI units
KEPT_TIME = 5  # rigid: time of the reference state, see `collapse.keep_state`
NUMBERS = 6

# `setting`: integers that a run does not change, finite contacts only
SERIES_ORDER = 0  # of the power series of nonlinear clusters
NONLINEAR = 1  # 1 where some contact can be nonlinear
RECORDS_PEAKS = 2  # 1 if peak forces, peak compressions and impulses are recorded
BONDS = 3  # number of contacts that never open
SETTINGS = 4

# `counter`: integers that a run changes
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
COUNTERS = 10

# `clock`: times
LAST_EVENT = 0
LAST_CHECK = 1  # finite: of the last event or check; 0 for rigid balls
CLOCKS = 2

# `resting`: integers, rigid balls only
BALLS_AT_REST = 0  # on the floor, the lowest ones
LOWEST_LOSSY = 1  # the lowest contact that loses energy; the number of balls if there is none
RESTINGS = 2

# `memory`: integers of the search for repeated states (`collapse`), rigid balls only
KEPT_CONTACT = 0  # the contact that had just collided in the reference state
KEEP_AFTER = 1  # number of collisions after which the reference state is replaced
SINCE_KEPT = 2  # number of collisions since the reference state
LOWEST_INVOLVED = 3  # lowest and highest contact that have collided since then
HIGHEST_INVOLVED = 4
MEMORIES = 5
