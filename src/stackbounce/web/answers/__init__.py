"""What is computed for each address: plain functions, which run in the processes that compute.

===== =====================================================================
play  a drop -> where everything is at each moment, and the textbook's drop
===== =====================================================================
"""
