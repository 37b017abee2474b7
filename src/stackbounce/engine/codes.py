"""Integer codes of statuses, forms of force, phases and events, and the columns of the log."""

# how a run ended
RUNNING = 0  # the log is full: the caller empties it and continues
FINISHED = 1
SETTLED = 2
COLLAPSED = 3
TIME_REACHED = 4
EVENT_LIMIT = 5
INVALID = 6
ASK = 7  # the fast engine left a drop undecided: the general one solves it

# why a run met a limit, see `Result.advice`
ENDLESS = 1  # events go on and on, or a stack that lies swings on
STIFF = 2  # a contact needs many steps between two events
EXTREME = 3  # the masses, or the times of the contacts, are of very different sizes

# forms of the force of a contact, see `forces`
ABSENT = 0  # no floor
POWER = 1  # a power of the compression, loading and unloading alike
HYSTERETIC = 2  # another power when unloading
PRODUCT = 4  # in the stack only: all forms from DASHPOT to RELAXING but RIGID, and BOND
DASHPOT = 5
VISCOELASTIC = 6
HUNT_CROSSLEY = 7
RIGID = 8
RELAXING = 10
PIECEWISE = 11  # in the stack only: TWO_STAGE and TABULATED
TWO_STAGE = 12
TABULATED = 13
BOND = 14  # a spring and a dashpot that also pull: the contact never opens
RIGID_POWER = 15  # an instantaneous collision whose restitution is a power of the speed
RIGID_LOSS = 16  # the same; its loss is a power of the speed

PAIR_FORMS = (POWER, HYSTERETIC, DASHPOT, VISCOELASTIC, HUNT_CROSSLEY)  # of `pairs`
LINEAR_FORMS = (POWER, DASHPOT, RELAXING)  # of `pairs`, by series: a power has the exponent 1

# phases of a contact; from COMPRESSING on it presses and joins its balls into a cluster
OPEN = 0
UNLOADED = 1  # still compressed; its force would pull and is clipped to zero
COMPRESSING = 2  # a product: in the whole interval; others: more compressed than before
RELEASING = 3  # compressed less than before

# kinds of event
CHECK = 0  # no event: the contact is to be checked again at that time
TOUCH = 1
RELEASE = 2
COLLISION = 3
PEAK = 4  # the compression stops growing
DIP = 5  # the compression of a contact with hysteresis stops falling
LINEARISED = 6  # the power law is replaced by its chord, see `contacts`
CURVED = 7  # the chord is replaced by the power law
RETURNED = 8  # the compression comes back to its last turning point but one, see `cycles`
CLIPPED = 9  # the force would begin to pull
RESUMED = 10  # the force would stop pulling
CROSSED = 12  # the compression passes from one piece of a curve into the next, see `pieces`
JOINED = 11  # the balls at contacts CONTACT to START have come together, at UPPER_VELOCITY

# the columns of the log of events
TIME, CONTACT, KIND, LOWER_VELOCITY, UPPER_VELOCITY = 0, 1, 2, 3, 4
START, PEAK_FORCE, PEAK_COMPRESSION, IMPULSE, PEAK_TIME = 5, 6, 7, 8, 9
LOG_COLUMNS = 10

EPSILON = 2.220446049250313e-16
