<<<<<<< HEAD
<<<<<<< HEAD
"""How often error bars hold the truth: records made, analysed and compared with what went in."""
=======
"""How often error bars cover the truth."""
>>>>>>> m-s
=======
"""How often error bars cover the truth."""
>>>>>>> m-p
