"""What a run costs: counted, not timed, so that a limit of it gives the same result everywhere.

The unit is one term of the power series of one contact: 5 to 30 ns, with all that goes with it. The
prices were fitted to the times of 300 runs of 1 to 500 balls, so that no run took longer than its
work times 30 ns, and most took half of that.
"""

EVENT_LIMIT = 1_000_000
"""The events after which a run stops by default."""

WORK_LIMIT = 150_000_000
"""The work after which a run stops by default: one to five seconds."""

LANE_EVENTS = 10_000
"""An event limit that no drop reaches to which an engine in lanes gives an answer."""

LANES_RTOL = 1e-13
"""The least tolerance of pairs in lanes: round-off accumulates over some 100 steps."""

LOOPS_RTOL = 1e-11
"""The least tolerance of pairs with hysteresis in lanes: below, the general engine is faster."""

ASKED_RTOL = 1e-13
"""The tolerance of a drop that an engine in lanes leaves to the general one, or a smaller one.

Such a drop is close to another number of contacts, which a larger tolerance might give it.
"""

SLICE = 2**17
"""The work after which a kernel returns to its caller, who may stop it: some milliseconds."""

DROP = 100  # to begin a drop, in the work of a slice only
STEP = 10  # to choose the next contact and find its next event
EXPANSION = 40  # to expand the motion of a cluster in a power series, besides its terms
MODES_WORK = 60  # to find normal modes, times the number of contacts
STANDSTILL = 1000  # for an event since the last of which no time has passed: more than it costs
CREST = 12  # to find the largest compression or force in a step, times the order of the series
CYCLE = 6  # for each cycle that a contact remembers, and each of its pieces, at a change of curve
COLLISION = 30  # of two rigid balls
LANE_STEP = 8  # of a drop in a lane of `pairs`
