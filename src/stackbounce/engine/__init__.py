"""The solvers: functions on numbers and flat arrays that never raise and return a status.

============= =====================================================================
compiler      marks kernels: plain Python for a few drops, compiled by numba for many
structure     how compiled kernels get at a stack's arrays
codes         integer codes of statuses, forms of force, phases and events
slots         names of the slots of a stack's small arrays
stack         the arrays that hold a stack of balls
preparation   fills a stack with a drop's numbers
event_queue   a priority queue of times
rigid         sequences of instantaneous collisions (eqs 1 to 4)
flight        the motion of rigid balls between collisions
settling      how rigid balls come to rest under gravity
collapse      infinitely many collisions in a finite time, detected by theory
series        power series: evaluation, shift, sign bounds
modes         a linear cluster: normal modes (eqs 5, 6)
taylor        any other cluster: the Taylor series of its motion
motion        displacement, velocity and compression at any time
forces        the forms of force: numbers, force, energy, power series
contacts      which force curve a contact follows, and how events change it
next_event    the next event of a contact, found so that none is missed
rest          when balls on finite contacts have come to rest under gravity
simultaneous  the event loop of a stack with finite contacts
batch         many drops one after the other in the arrays of one stack
two_springs   two balls on springs without gravity: many drops, fast
lockstep      one step of many such drops at the same time
trigonometry  cosine and (sin x)/x without branches
============= =====================================================================
"""
