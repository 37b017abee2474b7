"""A million random drops: nothing hangs, no number is lost, nothing comes from nothing."""
