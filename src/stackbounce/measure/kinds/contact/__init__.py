"""A contact time and a restitution that are known, without a file."""
