<<<<<<< HEAD
<<<<<<< HEAD
"""Records as an instrument would write them, made from the simulator: the truth is known."""
=======
"""Records as an instrument would have made them, of drops whose truth is known."""
>>>>>>> m-s
=======
"""Records whose truth is known: what the simulator and the laws say, measured with noise."""
>>>>>>> m-p
