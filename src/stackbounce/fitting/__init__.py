"""Measured drops -> parameters with uncertainties, and which model is right.

========== ============================================================================
quantities what can be measured of a drop, and what the engine says of it
measured   what was measured, with errors
waveforms  force records as data
parameters what is varied, between which bounds
ties       what follows from what is varied
formula    how that is written
problem    all of it together: residuals of many trials at once
question   what a user asks for -> the problem
files      a question from a TOML file
tables     drops, and what was measured of each, from a CSV file
search     many trials screened, the best followed down
run        ``fit``
found      what a fit found
residuals  what was measured beside what was fitted
notes      what should be known about it
profile    confidence intervals
posterior  draws from what is known after the data
model      what ``compare`` fits
standard   the usual models of a stack
comparison ``compare``
========== ============================================================================
"""

from stackbounce.extras import need
from stackbounce.fitting.comparison import Comparison, compare
from stackbounce.fitting.files import read_question
from stackbounce.fitting.model import Model
from stackbounce.fitting.parameters import Range
from stackbounce.fitting.posterior import Posterior
from stackbounce.fitting.profile import Interval
from stackbounce.fitting.question import Question
from stackbounce.fitting.residuals import Record, Residual
from stackbounce.fitting.result import Fit
from stackbounce.fitting.search_run import fit
from stackbounce.fitting.standard import standard_models
from stackbounce.fitting.tables import read_drops

__all__ = [
    "Comparison",
    "Fit",
    "Interval",
    "Model",
    "Posterior",
    "Question",
    "Range",
    "Record",
    "Residual",
    "compare",
    "fit",
    "read_drops",
    "read_question",
    "standard_models",
]

need("fit", "stackbounce fit")
