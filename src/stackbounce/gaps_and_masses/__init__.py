"""How the gaps, the choice of balls and their masses change the rebound of a stack's top ball.

================ =================================================================
gaps             one stack over all gaps, from touching balls to separate collisions
separation_limit the gap above which the collisions are separate
ranking          all stacks of given balls, in the order of the top ball's rebound
masses           the inner masses that give the top ball the highest rebound
batch            drops with equal contact laws and different numbers, solved in one sweep
================ =================================================================
"""

from stackbounce.gaps_and_masses.gaps import transition
from stackbounce.gaps_and_masses.masses import best_masses
from stackbounce.gaps_and_masses.ranking import highest

__all__ = ["best_masses", "highest", "transition"]
