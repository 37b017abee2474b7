"""Pictures of measurements: a file for each kind."""
