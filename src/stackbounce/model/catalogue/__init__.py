"""The catalogue: balls with their bounce on a hard floor, each number with its source.

There are two groups. The balls of Cross (2007), `BALLS`, sit on springs without loss: the spring of
a single ball has its dynamic stiffness, from its bounce on a hard floor. For some pairs of them the
paper fitted the spring between them: these pairs have that spring, in either order. If such a pair
is the lowest two balls in the order of the fit, it also has the fitted floor spring and gap.
Between any other two of them, their two springs act in series.

The balls that a class owns, `CLASS_BALLS`, lose energy as they do on a hard floor. Their contact
with the floor is `Hysteretic` with a linear loading curve: it is the simplest law that has the
measured restitution and the measured contact time exactly, at any speed, and for a pair as well as
for a ball. Between two balls, of which at least one is a class's, their floor contacts act in
series, and the contact loses what both lose: each takes a share of the work, the softer one the
larger. With the shares f and 1 - f, ``f = k_b/(k_a + k_b)``, it returns
``e**2 = f e_a**2 + (1 - f) e_b**2`` of the work. That is an assumption of this package, not a
measurement: a ball on a ball is taken to give way as it does on the floor.
"""

from stackbounce.model.catalogue.balls import BALLS as BALLS
from stackbounce.model.catalogue.balls import CLASS_BALLS as CLASS_BALLS
from stackbounce.model.catalogue.balls import ENTRIES as ENTRIES
from stackbounce.model.catalogue.balls import KINDS as KINDS
from stackbounce.model.catalogue.balls import PAIRS as PAIRS
from stackbounce.model.catalogue.balls import CatalogueBall as CatalogueBall
from stackbounce.model.catalogue.balls import Pair as Pair
from stackbounce.model.catalogue.stacking import DEFAULT_HEIGHT as DEFAULT_HEIGHT
from stackbounce.model.catalogue.stacking import Balls as Balls
from stackbounce.model.catalogue.stacking import balls as balls
from stackbounce.model.catalogue.stacking import catalogue_ball as catalogue_ball
from stackbounce.model.catalogue.stacking import stack as stack
from stackbounce.model.catalogue.stacking import stacked as stacked
