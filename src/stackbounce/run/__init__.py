"""From a drop, or many of them, to a result: one driver for all engines."""
