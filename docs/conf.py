"""Sphinx's settings. Nothing is fetched while building, and the pages fetch nothing.

Run `python -m sphinx` at the top of the repository, as `make docs` does: from there it finds the
extensions in `docs/_extensions`.
"""

import sys
from pathlib import Path

import matplotlib as mpl
from numpydoc.xref import DEFAULT_LINKS

from stackbounce import __all__ as public
from stackbounce.cross2007.style import use_style
from stackbounce.version import __version__

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))  # for the records of `synthetic`

project = "stackbounce"
author = "The stackbounce developers"
copyright = "2026, The stackbounce developers"
release = version = __version__

extensions = [
    "docs._extensions.datasets",
    "docs._extensions.explorer_page",
    "docs._extensions.lesson",
    "docs._extensions.mathml",
    "docs._extensions.measure_options",
    "docs._extensions.notebooks",
    "docs._extensions.offline",
    "docs._extensions.validation",
    "matplotlib.sphinxext.plot_directive",
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.githubpages",  # the file that makes hosts leave folders such as _static in place
    "sphinx.ext.intersphinx",
    "sphinx_copybutton",
]
exclude_patterns = ["_extensions", "figures"]
default_role = "literal"  # docstrings name arguments in single backticks

# References inside the package must resolve. Other projects' types are linked, those that arguments
# are of: inventories of these are kept here, as whole ones would come from the network.
intersphinx_mapping = {
    name: (address, f"_inventories/{name}.txt")
    for name, address in {
        "distributed": "https://distributed.dask.org/en/stable",
        "matplotlib": "https://matplotlib.org/stable",
        "numpy": "https://numpy.org/doc/stable",
        "xarray": "https://docs.xarray.dev/en/stable",
    }.items()
}
nitpicky = True
nitpick_ignore_regex = [(r"py:.*", r"(?!stackbounce\b).*")]

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings tell types, shapes and units
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"  # but for these, which are words of the docstrings
numpydoc_xref_aliases = {
    **{word: word for word in DEFAULT_LINKS},  # Python's own types need no link
    **{name: f"stackbounce.{name}" for name in public if name[0].isupper()},
    "DataArray": "xarray.DataArray",
    "Dataset": "xarray.Dataset",
    "ndarray": "numpy.ndarray",
    **{
        name: f":class:`{name}`"
        for name in (
            "distributed.Client",
            "matplotlib.axes.Axes",
            "matplotlib.figure.Figure",
            "numpy.ndarray",
            "numpy.random.Generator",
            "xarray.DataArray",
            "xarray.Dataset",
        )
    },
}
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
templates_path = ["_templates"]
html_title = f"stackbounce {version}"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["front.css", "lessons.css", "math.css"]
html_js_files = [("scroll.js", {"defer": "defer"})]
html_favicon = "../src/stackbounce/explorer/static/icon.svg"
html_domain_indices = False  # genindex has all names
html_copy_source = False
html_show_sourcelink = False
