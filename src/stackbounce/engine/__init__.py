"""The solvers: functions on numbers and flat arrays that never raise and return a status.

============= =====================================================================
kernels       marks kernels: plain Python that is compiled when the package is built
tables        how a compiled kernel receives a record of arrays: by one address
entries       the kernels that the compiled code offers
native        loads the compiled code of this machine
records       the records of arrays that a run takes besides its stack
memory        the memory in which drops are run, and the kernels that run them
one_ball      one collision of one ball with the floor
codes         integer codes of statuses, phases and events
slots         names of the slots of a stack's small arrays
stack         the arrays that hold a stack of balls
preparation   fills a stack with the parameters of a drop
event_queue   a priority queue of times
rigid         sequences of instantaneous collisions (eqs 1 to 4)
flight        the motion of rigid balls between collisions
restitution   of one rigid collision: constant, or by its speed and with scatter
settling      how rigid balls come to rest under gravity
collapse      inelastic collapse: infinitely many collisions in a finite time
series        power series: evaluation, shift, sign bounds
modes         a linear cluster: normal modes (eqs 5, 6)
taylor        any other cluster: the Taylor series of its motion
motion        displacement, velocity and compression at any time
forces        the forms of force: numbers, force, energy, power series
pieces        loading curves in pieces, of hollow balls and tables
cycles        hysteresis: what a contact remembers until it opens
bodies        balls joined by bonds
contacts      force curves, and how events change them
next_event    the next event of a contact, from rigorous bounds that miss no event
rest          when balls on finite contacts have come to rest under gravity
simultaneous  the event loop of a stack with finite contacts
log           the rows of the log of events
work          what a run costs, by which it is limited
ratios        rebound ratios and the retained energy
batch         one drop, or many one after the other, in the arrays of one stack
two_rigid     two rigid balls without gravity: many drops, fast
two_springs   two balls on springs without gravity: many drops, fast
pairs         two balls on other contacts: many drops, fast
pair_alone    one contact of two such balls that presses alone: without steps
pair_events   what happens to two such balls between steps
pair_cycles   the curve that a contact with hysteresis of such balls follows
pair_step     one step of many such drops at the same time
pair_series   the same by a power series, where both contacts are linear
sideways      how offsets of balls grow that do not stand exactly above each other
lockstep      one step of many drops of two balls on springs at the same time
elementary    exponential, logarithm, power, sine and cosine, the same bits on every system
trigonometry  cosine and (sin x)/x without branches
============= =====================================================================
"""
