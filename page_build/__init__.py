"""Make the explorer's page when the package is built.

=========== ================================================================
build       all files that are made, and whether they are up to date
data        laws, balls, cases, lessons, units and bounds, as JSON
examples    what to drop with the balls that a class owns, and what to see
lessons/    the lessons, for the page and the documentation
forms       the explorer as files for web servers, and as one HTML file
assembly    the texts that all forms are made of
bundle      ES modules to one classic script
=========== ================================================================

`python -m page_build` writes the files to `src/stackbounce/explorer/made`, which git ignores, after
`python -m kernel_build`; the build of a wheel does so, too (`hatch_build.py`). They fit exactly one
state of the package and of this folder. Where no kernels can be compiled there is no engine for
browsers, and no page.
"""
