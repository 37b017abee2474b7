"""Plots of measurements: a module for each kind of measurement."""
