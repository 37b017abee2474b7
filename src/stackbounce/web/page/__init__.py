"""What the page is made of besides the files in `static/`: made of the package, never typed twice.

=========== ================================================================
parts       all files that are made, by their names in the page
data        laws, balls, cases, units and bounds, as JSON
units       all units that the package reads, with their factors
laws        the formulas of the contact laws, as JavaScript
bounds      the numbers that a check lets through
translation Python to JavaScript, for these formulas
one_file    the whole explorer as one HTML file
bundle      ES modules to one classic script
=========== ================================================================
"""
