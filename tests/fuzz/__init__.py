"""Drops and files at random: nothing hangs, no number is lost, nothing comes from nothing."""
