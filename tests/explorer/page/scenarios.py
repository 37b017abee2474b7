"""Random drops as a page has them: valid ones of all laws, ones with units, and broken ones."""

import copy
import decimal
import random

import stackbounce as sb
from fuzz import draw
from fuzz.replay import drop_of

UNITS = {
    "mass": ("kg", "g", "pounds", "oz", "milligrams", "m", "kilofurlongs", "kg/s*s", "μg", "%"),
    "diameter": ("m", "mm", "inches", "ft", "cm", "angstrom", "s", "metres", "in", "m**1"),
    "stiffness": ("N/m", "kN/m", "N/mm", "lbf/in", "kg/s^2", "kg / s / s", "J/m**2", "N", "N·m^-1"),
    "impact_speed": ("m/s", "km/h", "mph", "knots", "cm per s", "meters per second", "metre/sec"),
    "height": ("m", "cm", "yards", "km", "nm", "parsec", "square m", "m squared", "kg"),
    "gravity": ("m/s^2", "m/s**2", "g", "cm/s/s", "Gal", "m s**-2", "ft/s^2", "m/s²", "dB"),
    "gaps": ("mm", "um", "µm", "mil", "thou", "m", "nm", "px", "degC", "dam", "mm mm"),
}
NUMBERS = (0.0, -1.0, 1e-320, 1e308, 3, -0.003, 1e22, 12345678901234567890, 2.5e-7, True, 1e-5)
TEXTS = ("", " ", "NaN", "inf", "1e999", "one", "1,5 m", "-", "5", " 5 ", "1e3", ".5 m", "5 m m")
MORE = {  # of a ball
    "name": ("tennis", "", " ", "<b>", 'it\'s "a"', "Ball\n2", "ä\u200b"),
    "poisson_ratio": (0.3, -1, 0.5, 0.51, "0.3", "30 %"),
    "young_modulus": (2e11, "206 GPa", "1 atm", -1, "3 N/mm**2"),
}
LUMPS = (None, [], {}, [1], [1.5, "2 mm"], {"a": 1}, "Spring", "a\tb'c", "\ud83c", "🎱", [None])


def drawn(seed, batch, count):
    """Return random drops of fuzz.draw as mappings."""
    drops = draw.drops_of(seed, batch, count)
    return [drop_of(drops, row).to_mapping() for row in range(count)]


def scenario(chance):
    """Return a drop as somebody might give it, often with a mistake."""
    balls = chance.choice((1, 1, 2, 2, 3, 5, 6, 7))
    rigid = chance.random() < 0.2
    drop = {
        "balls": [ball(chance) for _ in range(balls)],
        "contacts": [law(chance, rigid) for _ in range(balls)],
    }
    if chance.random() < 0.2:
        drop["contacts"][0] = {"law": chance.choice(("none", "None", "NONE"))}
    if chance.random() < 0.6:
        drop["gaps"] = [number(chance, "gaps") for _ in range(balls - 1)]
    if chance.random() < 0.5:
        drop["gravity"] = number(chance, "gravity")
    way = chance.choice(("impact_speed", "height", "velocities"))
    speeds = [number(chance, "impact_speed") for _ in range(balls)]
    drop[way] = speeds if way == "velocities" else number(chance, way)
    for _ in range(chance.choice((0, 0, 1, 1, 2))):
        spoil(chance, drop)
    return drop


def ball(chance):
    made = {"mass": number(chance, "mass")}
    if chance.random() < 0.3:
        made["diameter"] = number(chance, "diameter")
    for name, choices in MORE.items():
        if chance.random() < 0.25:
            made[name] = chance.choice(choices)
    return made


def law(chance, rigid):
    names = [name for name, one in sb.model.LAWS.items() if one.rigid == rigid]
    name = chance.choice(names)
    made = {"law": chance.choice((name, name.lower(), name.upper(), name))}
    for field, one in sb.model.LAWS[name].quantities().items():
        default, low, high = one.slider
        made[field] = chance.choice((default, low, high, chance.uniform(low, high)))
        if field == "stiffness" and chance.random() < 0.3:
            made[field] = number(chance, field)
    if {"restitution", "unloading_exponent"} <= set(made):
        del made[chance.choice(("restitution", "unloading_exponent"))]
    return made


def number(chance, of):
    """Return a number, or a text with a unit."""
    size = chance.choice((1.0, 1e-3, 20.0, 0.15, 2500.0, chance.uniform(0.0, 10.0)))
    if chance.random() < 0.7 or of not in UNITS:
        return size
    written = chance.choice((repr(size), f"{size:g}", f"{size:.3e}", f"+{size}"))
    return written + chance.choice((" ", "", "  ")) + chance.choice(UNITS[of])


def spoil(chance, drop):
    """Change one thing of a drop for the worse."""
    places = list(parts(drop))
    place, key = chance.choice(places)
    worse = copy.deepcopy(chance.choice((*NUMBERS, *TEXTS, *LUMPS)))
    way = chance.random()
    if way < 0.15:
        del place[key]
    elif way < 0.3 and isinstance(place, dict):
        place[chance.choice(("mas", "stifness", "Mass", "law", "exponent", "x y", "", "é"))] = worse
    else:
        place[key] = worse


def parts(value):
    """Yield each place of a drop, with its key there."""
    for key, one in list(value.items() if isinstance(value, dict) else enumerate(value)):
        yield value, key
        if isinstance(one, dict | list):
            yield from parts(one)


def scenarios(seed, count):
    """Return random drops, valid and broken, as a browser writes them."""
    chance = random.Random(seed)
    return [as_browser(scenario(chance)) for _ in range(count)]


def as_browser(value):
    """Return a value as JSON of a browser has it: 1.0 is 1, and whole numbers are floats."""
    if isinstance(value, dict):
        return {key: as_browser(one) for key, one in value.items()}
    if isinstance(value, list):
        return [as_browser(one) for one in value]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    near = float(value)
    if not near.is_integer() or abs(near) >= 1e21:
        return near
    digits = repr(near)  # the shortest that are enough, and then zeros
    return int(decimal.Decimal(digits))
