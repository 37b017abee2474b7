"""What the library answers to the page's questions."""

import numpy as np
from page_build.data import MAP_RTOL, WORDS

import stackbounce as sb
from stackbounce.errors import InvalidValue, StackbounceError
from stackbounce.explorer.limits import LIMITS, RTOL
from stackbounce.json_values import plain
from stackbounce.model import law_named
from stackbounce.plots.impact import choose_window, sample_with_approach
from stackbounce.run.batch import solve
from stackbounce.run.options import run_options
from stackbounce.run.paths import drop_at, number_at, numbers_of
from stackbounce.run.result import heights_of

RATIOS, OUTCOMES = WORDS["ratios"], WORDS["outcomes"]
FLOOR = sb.Rigid(0.8)  # in place of none
CONTACT_TIME = 5e-3  # s, in place of a rigid contact's
EXPONENT = 1.5  # in place of that of a law without one
SAMPLES = 1001  # of a table
UNMAPPED = ("diameter", "young_modulus", "poisson_ratio")


def calibrated(law, **measured):
    """Return a law with the constants that follow from what was measured."""
    given = {name: value for name, value in measured.items() if value is not None}
    return {"contact": sb.calibrate(law_named(law), **given).to_mapping()}


def converted(contact, to, mass, impact_speed, restitution, contact_time):
    """Return another law with the restitution and the contact time of a contact."""
    contact = contact or FLOOR
    law, at = law_named(to), (mass, impact_speed)
    given = {"contact_time": contact_time, "impact_speed": impact_speed, "mass": mass}
    given["contact_time"] = contact_time or sb.contact_time(contact, *at) or CONTACT_TIME
    if law.loss:
        given["restitution"] = restitution or sb.restitution(contact, *at)
    if law.default_exponent() is None and not law.rigid:
        given["exponent"] = getattr(contact, "exponent", EXPONENT)
    return calibrated(to, **given)


def stacked(balls, height):
    """Return balls of the catalogue on each other, and the sources of their numbers."""
    chosen = sb.model.catalogue.stacked(balls)
    drop = sb.Drop(chosen.balls, chosen.contacts, chosen.gaps, height=height)
    sources = {"contact_sources": chosen.contact_sources, "gap_sources": chosen.gap_sources}
    return {"drop": drop.to_mapping()} | sources


def run(drop, until=None, events=LIMITS.events):
    return sb.simulate(drop, until=until, rtol=RTOL, event_limit=events)


def played(mapping, until, times, events=LIMITS.events):
    """Return what there is to say of a drop, with its motion at some times."""
    drop = sb.Drop.from_mapping(mapping)
    result = run(drop, until, events)
    ends = result.intervals["end"]
    answer = {
        "drop": drop.to_mapping(),
        "reference_speed": drop.reference_speed,
        **numbers(result, drop),
        "intervals": result.intervals,
        "impact": [0.0, max(ends[np.isfinite(ends)], default=0.0)],
        "frames": frames(result, times),
        "separate": None if drop.rigid else separate(drop, until, times, events),
    }
    return plain(answer)


def numbers(result, drop):
    """Return what came out of a run, with heights by the gravity of a drop."""
    heights = heights_of(result.rebound_speeds, drop.gravity)
    found = result.to_mapping() | {"rebound_heights": heights}
    del found["advice"]  # the page has words of its own
    return found


def frames(result, times):
    """Return the motion and the energies of a drop, from before the first touch on."""
    sample = sample_with_approach(result, times)
    mass = np.array([ball.mass for ball in result.drop.balls])[:, None]
    kinetic = 0.5 * mass * sample["velocity"] ** 2
    potential = np.sum(mass * result.drop.gravity * sample["position"], axis=0)
    total = sample["energy"]  # the same on the way down
    stored = np.maximum(total - np.sum(kinetic, axis=0) - potential, 0.0)
    energy = {"kinetic": kinetic, "stored": stored, "potential": potential, "total": total}
    names = ("time", "position", "velocity", "force", "compression")
    return {name: sample[name] for name in names} | {"energy": energy}


def separate(drop, until, times, events):
    """Return what separate collisions make of a drop; with the flights of a whole one."""
    try:
        textbook = sb.separate(drop)
        if until is not None:
            textbook = textbook.replace(gravity=drop.gravity)
        result = run(textbook, until, events)
        reached = result.end_time if result.status > sb.Status.COLLAPSED else np.inf
        place = sample_with_approach(result, np.minimum(times, reached))["position"]
    except StackbounceError as error:
        return {"error": str(error)}
    restitutions = [law and law.restitution for law in textbook.contacts]
    return numbers(result, drop) | {"restitutions": restitutions, "position": place}


def table(drop):
    """Return the columns of a drop's table by their headings."""
    result = run(drop)
    times = np.linspace(*choose_window(result), SAMPLES)
    sample = sample_with_approach(result, times)
    columns = {"time (s)": times}
    for name, unit in (("position", "m"), ("velocity", "m/s"), ("force", "N")):
        rows = enumerate(sample[name])
        columns |= {f"{name} {i} ({unit})": values for i, values in rows}
    return columns | {"energy (J)": sample["energy"]}


def varying(drop):
    """Return the numbers of a drop that a map can vary, ratios first, by their paths."""
    numbers = numbers_of(drop)
    units = {path: number.unit for path, number in numbers.items()}
    found = {}
    for name, ratio in RATIOS.items():
        pair = ratio["sets"], ratio["refers"]
        if set(pair) <= set(numbers) and units[pair[0]] == units[pair[1]]:
            found[name] = number_in(drop, pair[0]) / number_in(drop, pair[1])
    for path, number in numbers.items():
        value = number_in(drop, path)
        if value is not None and number.field not in UNMAPPED:
            found[path] = value
    return found


def number_in(drop, path):
    number = number_at(drop, path)
    part = getattr(drop, number.part)[number.index] if number.part else drop
    return getattr(part, number.field) if number.field else part


def at(mapping, path, value):
    """Return a drop with another value of a number, or of a ratio."""
    drop = sb.Drop.from_mapping(mapping)
    if path in RATIOS:
        path, other = RATIOS[path]["sets"], RATIOS[path]["refers"]
        value *= number_in(drop, other)
    return drop_at(drop, {number_at(drop, path): value})


def outcome(drop, show, index, event_limit, gravity=None):
    """Return what the library finds of a drop; None where it does not come to its end."""
    out = solve(drop, {}, (1,), run_options(drop, None, MAP_RTOL, event_limit))
    if out.status[0] > sb.Status.COLLAPSED:
        return None
    if show == "energy_retained":
        return finite(out.energy_retained[0])
    if show == "collisions":
        return int(out.collisions[0, index])
    if show == "rebound_ratio":
        return finite(out.rebound_ratio[0, index])
    speed = out.rebound_ratio[0, index] * max(map(abs, drop.start_velocities))
    return finite(heights_of(speed, drop.gravity if gravity is None else gravity))


def finite(value):
    """Return a number, or None for one that JSON does not have."""
    return float(value) if np.isfinite(value) else None


def mapped(mapping, x, y, show, event_limit):
    """Return the values of a map, each of a drop of its own."""
    name, _, index = show.partition(".")
    sides = sorted((x, y), key=lambda side: side["path"] in RATIOS)
    last = RATIOS.get(sides[1]["path"], {})
    if x["path"] == y["path"] or last.get("sets") == sides[0]["path"]:
        raise InvalidValue("x and y must be independent")
    part, _, first = sides[0]["path"].rpartition(".")
    other, _, second = sides[1]["path"].rpartition(".")
    if part == other and {first, second} == {"restitution", "unloading_exponent"}:
        raise InvalidValue("only one of the two can vary")
    if name != "energy_retained" and not (name in OUTCOMES and int(index) < len(mapping["balls"])):
        raise InvalidValue(f"{show} is no outcome")

    def value(x_value, y_value):
        pair = {x["path"]: x_value, y["path"]: y_value}
        first = at(mapping, sides[0]["path"], pair[sides[0]["path"]])
        drop = at(first.to_mapping(), sides[1]["path"], pair[sides[1]["path"]])
        return outcome(drop, name, int(index or 0), event_limit)

    return [[value(x_value, y_value) for x_value in spread(x)] for y_value in spread(y)]


def spread(side):
    """Return the values along a side of a map."""
    low, high = side["low"], side["high"]
    if low == high or (side["log"] and min(low, high) <= 0.0):
        raise InvalidValue("low and high must differ, and be above 0 on a logarithmic scale")
    return (np.geomspace if side["log"] else np.linspace)(low, high, side["count"]).tolist()
