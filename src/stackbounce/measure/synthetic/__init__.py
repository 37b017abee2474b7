"""Records as an instrument would have made them, of drops whose truth is known."""
