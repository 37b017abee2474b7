"""One collision of one ball: its units, and root finding and integration for the closed forms."""
