"""Sphinx's settings. Nothing is fetched while building, and the pages fetch nothing.

Run `python -m sphinx` at the top of the repository, as `make docs` does: from there it finds the
extensions in `docs/_extensions`.
"""

import sys
from pathlib import Path

import matplotlib as mpl

from stackbounce.cross2007.style import use_style
from stackbounce.version import __version__

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))  # for the records of `synthetic`

project = "stackbounce"
author = "The stackbounce developers"
copyright = "2026, The stackbounce developers"
release = version = __version__

extensions = [
    "docs._extensions.captions",
    "docs._extensions.datasets",
    "docs._extensions.explorer_page",
    "docs._extensions.lesson",
    "docs._extensions.mathml",
    "docs._extensions.measure_options",
    "docs._extensions.offline",
    "docs._extensions.validation",
    "matplotlib.sphinxext.plot_directive",
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_copybutton",
]
exclude_patterns = ["_extensions", "figures"]
default_role = "literal"  # docstrings name arguments in single backticks

# References inside the package must resolve; other projects' names are not linked, as that would
# need their inventories from the network.
nitpicky = True
nitpick_ignore_regex = [(r"py:.*", r"(?!stackbounce\b).*")]

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings tell types, shapes and units
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_validation_checks = {"GL01", "GL02", "GL06", "GL07", "PR01", "PR02", "PR03", "SS03"}
numpydoc_validation_exclude = {
    r"\.Status$",  # an enumeration's signature is Python's
    r"\.Air\.",  # the class says what its methods take and raise, once for all
}

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

# The notebooks run when the pages are built; an error in one ends the build.
nb_execution_mode = "force"
nb_execution_timeout = 60  # s, of one cell
nb_execution_raise_on_error = True
nb_code_prompt_show = nb_code_prompt_hide = "The code"
math_number_all = False
math_eqref_format = "({number})"

# The figures of docs/figures are drawn while building, in the style of the paper's.
plot_formats = [("svg", 200)]  # dots per inch of maps
plot_html_show_formats = False
plot_apply_rcparams = True
with use_style():
    plot_rcparams = {k: v for k, v in mpl.rcParams.items() if v != mpl.rcParamsDefault[k]}

# Of a block with prompts, the button copies what is typed, without them.
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
copybutton_line_continuation_character = "\\"

html_theme = "furo"
html_title = f"stackbounce {version}"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["front.css", "lessons.css", "math.css"]
html_copy_source = False
html_show_sourcelink = False
