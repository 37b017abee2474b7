"""The answers: plain functions that run in the worker processes and return JSON.

=========== ===================================================================
predictions a drop and errors of its numbers -> numbers and curves with errors
records     a file -> its results; a drop -> the drop fitted to it
=========== ===================================================================
"""
