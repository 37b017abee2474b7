"""Independent reference solutions, in mpmath and exact fractions: the tests' second opinion.

`precise` integrates finite laws by Taylor series, `rigid` and `falling` solve sequences of
collisions (eqs 1 to 4); these import nothing of stackbounce. `pieces` and `relaxing` leave the
steps to SciPy. `data` reads what is stored in `tests/data`. Two more, `normal_modes` (eqs 5 and 6)
and `hysteretic_series`, are with the benchmarks, which alone use them.
"""
