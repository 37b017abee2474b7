"""Records as an instrument would write them, made from the simulator: the truth is known."""
