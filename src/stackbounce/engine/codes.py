"""The integers that stand for statuses, laws, phases and kinds of event inside the kernels."""

# how a run ended
RUNNING = 0  # the log is full: empty it and call again
FINISHED = 1
SETTLED = 2
COLLAPSED = 3
TIME_REACHED = 4
EVENT_LIMIT = 5
INVALID = 6
ASK = 7  # a fast form of the engine is not sure of a drop: ask the general one

# forms of the force of a contact
ABSENT = 0  # no floor
POWER = 1  # F = k c^p, loading and unloading alike
HYSTERETIC = 2  # F = k c^p loading, k C^p (c/C)^n unloading from the peak C
LOSSY = 3  # the same, and every reloading loses the share of its work that the first loading lost
DAMPED = 4  # F = max(0, K c^q (a + b c + d c'))
# further forms that a contact is told by; `prepare` makes them DAMPED, with these numbers
DASHPOT = 5  # K = k, q = 0, a = 0, b = 1, d = damping/k
VISCOELASTIC = 6  # K = k, q = 1/2, a = 0, b = 1, d = 3/2 dissipative time
HUNT_CROSSLEY = 7  # K = k, q = p, a = 1, b = 0, d = dissipation
RIGID = 8  # an instantaneous collision

# phases of a contact; from COMPRESSING on it presses and joins its balls to a cluster
OPEN = 0
SLACK = 1  # compressed still, but its force, which would pull, is cut off at zero
COMPRESSING = 2  # a damped contact stays here; any other one is above all it was compressed before
RELEASING = 3  # compressed less than before

# kinds of event
LOOK = 0  # nothing happened yet: look again at that time
TOUCH = 1
RELEASE = 2
COLLISION = 3
PEAK = 4  # the compression stops growing
DIP = 5  # the compression of a lossy contact stops falling
FAINT = 6  # the force sinks below round-off: the power law is continued by its chord
PRESSED = 7  # ... and rises above it
RELOADED = 8  # a contact is compressed as much as ever before
CLIPPED = 9  # the force would begin to pull
RESUMED = 10  # the force would end to pull
JOINED = 11  # the balls at contacts CONTACT to START have come together, at UPPER_VELOCITY

# the columns of a log of events
TIME, CONTACT, KIND, LOWER_VELOCITY, UPPER_VELOCITY = 0, 1, 2, 3, 4
START, PEAK_FORCE, PEAK_COMPRESSION, IMPULSE = 5, 6, 7, 8
LOG_COLUMNS = 9

EPSILON = 2.220446049250313e-16
