"""Records whose truth is known: what the simulator and the laws say, measured with noise."""
