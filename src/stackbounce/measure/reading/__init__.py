"""Files of measurements -> xarray, recognised by their content.

========== ====================================================================
reader     `read`: a path -> a Dataset
options    the options of `read`, their effect on columns, the part that is read
limits     limits on what is read: size, folders, other kinds of file
text       bytes -> text -> delimiter, decimal mark, the cells of the first lines
numbers    the rows below -> an array, by pandas where they are plain
roles      "Run 1: Time (ms)" -> name, unit and run of a column, and what it is
layouts    where a table's columns are; without names, what their numbers look like
formats    which program wrote a table: a function for each
video      frames as times, pixels as lengths, one row for each frame
dataset    columns -> the Dataset of what they hold
series     times: since when, in which unit; runs, gaps, repeats, and rounded ones
tables     the tables in a zip archive, a spreadsheet, own files of programs, arrays of NumPy
wav        sound, decoded by scipy
========== ====================================================================
"""

from stackbounce.measure.reading.reader import read, read_content

__all__ = ["read", "read_content"]
