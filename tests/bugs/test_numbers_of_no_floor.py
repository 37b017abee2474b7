"""The placeholder numbers of an absent floor gave linear drops the tolerances of nonlinear ones."""

import numpy as np

from stackbounce.engine import codes, preparation
from stackbounce.engine.records import Drops
from stackbounce.engine.stack import new_stack


def test_numbers_of_no_floor_do_not_matter():
    stacks = []
    for numbers in ((1.0, 1.0, 0.0, 0.0), (7e3, 1.5, 3.0, 2.0)):
        stack = new_stack(2)
        forms = [[codes.ABSENT, codes.POWER]]
        given = [[[number, 1.0]] for number in numbers]
        drops = Drops([[0.1, 0.2]], forms, *given, [[0.0, 0.0]], [[-1.0, -2.0]], [0.0])
        preparation.prepare(stack, drops, 0, 1e-12)
        stacks.append(stack)
    for name, one, other in zip(stacks[0]._fields, *stacks, strict=True):
        np.testing.assert_array_equal(one, other, err_msg=name)
