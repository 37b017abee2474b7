"""Simulated records as instruments write them, whose true values are known."""
