"""Attacks on the package, bounded in time."""
