"""One collision of one ball: its units, and root finding for the closed forms."""
