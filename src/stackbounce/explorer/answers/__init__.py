"""The answers: plain functions that run in the worker processes and return JSON or files.

=========== ===================================================================
play        a drop -> its motion, and the separate collisions beside it
predictions a drop and errors of its numbers -> numbers and curves with errors
maps        a drop and two of its numbers -> a number of the outcome over both
catalogue   balls, laws and examples; a law from measurements
examples    what to drop with the balls that a class owns, and what to see
records     a file -> its results; a drop -> the drop fitted to it
exports     a drop -> a file: data, picture, scenario, lines of Python
paper       the paper's pages
=========== ===================================================================
"""
