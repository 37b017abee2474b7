"""Other solvers on the same drops, each in a file of its own."""
