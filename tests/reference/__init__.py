"""Independent reference solutions, in mpmath and exact fractions: the tests' second opinion.

Nothing here imports stackbounce. `springs` solves linear springs from the closed forms of
eqs 5 and 6 (modes), `rigid` solves sequences of collisions (eqs 1 to 4), `precise`
integrates all finite laws by Taylor series, and `make_data` and others write `tests/data`.
"""
