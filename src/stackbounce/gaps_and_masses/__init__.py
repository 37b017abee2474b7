"""Which gaps, which balls, which masses: what makes the top ball of a stack go high.

======= ==========================================================================
gaps    one stack with all gaps from touching to separate
apart   from which gap on the collisions are separate
ranking the stacks that can be made of some balls, the one that throws highest first
masses  the masses in between that throw the top ball highest
many    drops of one kind with different numbers, solved together
======= ==========================================================================
"""

from stackbounce.gaps_and_masses.gaps import transition
from stackbounce.gaps_and_masses.masses import best_masses
from stackbounce.gaps_and_masses.ranking import highest

__all__ = ["best_masses", "highest", "transition"]
