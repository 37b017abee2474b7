"""Which balls, in which order, with which gaps and which masses, throw the top ball highest.

========== =======================================================================
batch      drops with equal contact laws and different numbers, solved in one sweep
separation the gap above which the collisions of a stack are separate
masses     the inner masses that give the top ball the highest rebound
ranking    all stacks of given balls, in the order of the top ball's rebound
========== =======================================================================
"""

from stackbounce.towers.masses import best_masses
from stackbounce.towers.ranking import highest
from stackbounce.towers.separation import separation_limit

__all__ = ["best_masses", "highest", "separation_limit"]
