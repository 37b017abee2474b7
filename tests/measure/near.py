"""Whether a number with an error is right."""


def near(found, true, errors=3.0):
    """Return whether a number is within some of its errors of the true one."""
    return abs(found.nominal_value - true) <= errors * found.std_dev + 1e-9 * abs(true)
