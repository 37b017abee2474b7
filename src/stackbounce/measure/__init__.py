"""From what was measured to parameters with error bars."""
