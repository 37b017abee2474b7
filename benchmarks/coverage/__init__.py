"""How often error bars cover the truth."""
