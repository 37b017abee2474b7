"""What the page is made of besides the files in `static/`: made of the package, never typed twice.

=========== ================================================================
parts       all files that are made, by their names in the page
data        laws, balls, cases, lessons, units and bounds, as JSON
catalogue   balls, laws, examples and limits
lessons     the lessons, with links that the page can follow
units       all units that the package reads, with their factors
bounds      the numbers that a check lets through
policy      the content security policy of a page that comes from a server
one_file    the whole explorer as one HTML file
folder      the whole explorer as a folder for any web server
assembly    the texts that one_file and folder are made of
bundle      ES modules to one classic script
=========== ================================================================
"""
