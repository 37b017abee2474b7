"""Files of measurements -> xarray, recognised by their content.

========== ====================================================================
reader     `read`: a path -> a Dataset
options    the options of `read`, and their effect on columns
limits     limits on what is read: size, folders, other kinds of file
text       bytes -> text -> delimiter, decimal mark, the cells of the first lines
numbers    the rows below -> an array, by pandas where they are plain
headings   "Run 1: Time (ms)" -> name, unit, run
roles      names and units -> what a column is
layouts    which program wrote a table, and where its columns are
formats/   a function for each program whose tables are recognised
bare       columns without names -> what their numbers look like
video      frames as times, pixels as lengths, one row for each frame
dataset    columns -> the Dataset of what they hold
clock      what a column of times counts: since when, in which unit
part       what lies between two times, frames or rows
series     the rows in time: runs, gaps, repeats, and times that were rounded
tables     the tables of a file with several, or in a packing of its own, as bytes
zipped     a zip archive
sheets     spreadsheets of Excel
projects   own files of Tracker and Logger Pro
arrays     arrays of NumPy
wav        sound, decoded by scipy
========== ====================================================================
"""

from stackbounce.measure.reading.reader import read, read_content

__all__ = ["read", "read_content"]
