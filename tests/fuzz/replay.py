"""Random drops as the package's users write them."""

import numpy as np

import stackbounce as sb
from fuzz.draw import Drops


def law_of(drops: Drops, row: int, i: int) -> sb.model.ContactLaw | None:
    k, p = float(drops.first[row, i]), float(drops.second[row, i])
    extra = float(drops.third[row, i])
    match int(drops.law[row, i]):
        case 0:
            return None
        case 1:
            return sb.Spring(k)
        case 2:
            return sb.Hertz(k)
        case 3:
            return sb.PowerLaw(k, p)
        case 4:
            return sb.Dashpot(k, extra)
        case 5:
            return sb.Viscoelastic(k, extra)
        case 6:
            return sb.HuntCrossley(k, p, extra)
        case 7:
            return sb.Hysteretic(k, exponent=p, unloading_exponent=extra)
        case 9:
            return sb.StandardLinearSolid(k, extra, float(drops.fourth[row, i]))
        case _:
            return sb.Rigid(extra)


def drop_of(drops: Drops, row: int) -> sb.Drop:
    """Return one drop of a batch as the package's users write it."""
    balls = drops.mass.shape[1]
    return sb.Drop(
        [sb.Ball(mass) for mass in drops.mass[row].tolist()],
        [law_of(drops, row, i) for i in range(balls)],
        drops.gap[row, 1:].tolist(),
        velocities=drops.velocity[row].tolist(),
        gravity=float(drops.gravity[row]),
    )


def options_of(drops: Drops, row: int) -> dict[str, float]:
    """Return the arguments of `simulate` with which a drop of a batch is run."""
    options = {"rtol": float(drops.rtol[row]), "event_limit": int(drops.limit[row])}
    return options | ({"until": float(drops.until[row])} if drops.until[row] < np.inf else {})


def expression(drops: Drops, row: int) -> str:
    """Return what runs one drop of a batch again, to be pasted after `import stackbounce as sb`."""
    drop = drop_of(drops, row)
    balls = ", ".join(f"sb.Ball({ball.mass!r})" for ball in drop.balls)
    laws = ", ".join("None" if law is None else f"sb.{law!r}" for law in drop.contacts)
    more = f", gravity={drop.gravity!r}" if drop.gravity else ""
    options = "".join(f", {name}={value!r}" for name, value in options_of(drops, row).items())
    return (
        f"sb.simulate(sb.Drop([{balls}], [{laws}], {list(drop.gaps)!r}, "
        f"velocities={list(drop.velocities)!r}{more}){options})"
    )
