"""How often error bars hold the truth: records made, analysed and compared with what went in."""
