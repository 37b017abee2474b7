"""The solvers: functions on numbers and flat arrays that never raise and say how they ended.

============= =====================================================================
kernel        one source, two modes: plain Python for a few drops, numba for many
codes         the integers that stand for statuses, laws, phases and kinds of event
stack         the arrays that hold a stack of balls
prepare       from a drop's own numbers to a stack at t = 0
queue         which of many times comes first
rigid         sequences of instantaneous collisions (eqs 1 to 4)
flight        rigid balls between their collisions: straight lines and parabolas
settle        how rigid balls come to rest under gravity
collapse      when a sequence of collisions is infinite, decided by theory
series        Taylor series: how far one surely keeps its sign, powers, shifts
modes         a small cluster all of whose contacts are springs: normal modes (eqs 5, 6)
taylor        any other cluster: the power series of its motion, step by step
motion        displacement, velocity and compression at any time, whatever the cluster
contacts      the curve that a contact's force follows, and how events change it
watch         what ends the present phase of a contact, and when: no event is missed
rest          when soft balls under gravity have come to rest
simultaneous  the event loop of a stack with finite contacts
many          many drops one after the other in the arrays of one stack
two_springs   two balls on springs without gravity: many drops, fast
lanes         one look at each of many such drops, in lock step
waves         cosine, (sin x)/x and short steps of a wave, without branches
============= =====================================================================
"""
