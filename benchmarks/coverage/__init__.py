"""How often error bars hold the truth: records are made, analysed, and compared with what went in."""
