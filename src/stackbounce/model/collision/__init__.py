"""One collision of one ball: units of length and time, roots and integrals of the closed forms."""
