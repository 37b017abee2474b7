"""Random drops as a page has them."""

from fuzz import draw
from fuzz.replay import drop_of


def drawn(seed, batch, count):
    """Return random drops of fuzz.draw as mappings."""
    drops = draw.drops_of(seed, batch, count)
    return [drop_of(drops, row).to_mapping() for row in range(count)]
