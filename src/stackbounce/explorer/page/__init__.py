"""What the page is made of besides the files in `static/`: made of the package, never typed twice.

=========== ================================================================
parts       all files that are made, by their names in the page
data        laws, balls, cases, lessons, units and bounds, as JSON
policy      the content security policy of a page that comes from a server
folder      the whole explorer as one HTML file, or as a folder for any web server
assembly    the texts that both are made of
bundle      ES modules to one classic script
=========== ================================================================
"""
