"""The gap between two falling balls, from delays and from the force on the floor."""
