"""Statistics that several kinds of measurement share: regression, AR noise, change points."""
