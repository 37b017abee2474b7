"""Accelerations of what falls and bounces: flights, restitutions, drop height."""
