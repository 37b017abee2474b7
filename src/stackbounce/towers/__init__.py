"""Which balls, in which order, with which gaps and which masses, throw the top ball highest.

========== =======================================================================
separation the gap above which the collisions of a stack are separate
masses     drops solved in one sweep; the inner masses that send the top ball highest
ranking    all stacks of given balls, in the order of the top ball's rebound
========== =======================================================================
"""

from stackbounce.towers.masses import best_masses
from stackbounce.towers.ranking import highest
from stackbounce.towers.separation import separation_limit

__all__ = ["best_masses", "highest", "separation_limit"]
