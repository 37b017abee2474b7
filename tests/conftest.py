"""Settings shared by all tests."""

import matplotlib as mpl
from hypothesis import settings

mpl.use("Agg")

# The same examples in every run; `pytest --hypothesis-profile=explore` looks for new ones.
settings.register_profile("steady", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=2000)
settings.load_profile("steady")
