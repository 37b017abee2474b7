"""Press curves: static stiffness, exponent, energy loss and unloading exponent."""
