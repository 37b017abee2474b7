"""What must not change while the package is rebuilt: its answers, kept as numbers and texts.

``make frozen`` (``PYTHONPATH=.. python -m frozen`` in ``tests``) computes all groups again and
compares them with `data`; with ``--write`` it writes `data` anew. Answers are asked for by the
command line, the public names and HTTP, so that modules can move. Only `coverage` and `drops`
import more: what they need stands at the top.
"""
