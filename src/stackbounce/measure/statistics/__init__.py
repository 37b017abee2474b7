"""Statistics of several kinds: regression, AR noise."""
