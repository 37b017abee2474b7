"""One model fitted to all of Table II: its quality, the losses, and measurements to decide."""
