"""The kinds of measurement: a folder for each, with its analysis and its result."""
