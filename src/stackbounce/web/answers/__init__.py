"""What is computed for each address: plain functions, which run in the processes that compute.

========= =======================================================================
play      a drop -> where everything is at each moment, and the textbook's drop
maps      a drop and two of its numbers -> a number of the outcome over both
catalogue balls, laws and the paper's cases; a law from what was measured
records   a file -> what was found in it; a drop fitted to it
exports   a drop -> a file: data, picture, scenario, lines of Python
paper     the paper's pages
warm      the compiled kernels, before anything is asked
========= =======================================================================
"""
