"""Measured drops -> parameters with uncertainties, and a comparison of models.

The files in the order of their imports:

============= ====================================================================
quantities    what can be measured of a drop, and how it follows from a run
waveforms     force records as data
measurements  what was measured of a drop, with errors
formula       the formulas of ties
course        what a search costs, and the best trial so far
parameters    what is varied, with bounds and priors
ties          what follows from what is varied
objective     residuals and chi squared of many trials at once
covariance    directions that the data determine, and the covariance matrix
least_squares the search for the minima of chi squared
residuals     what was measured beside what was fitted
notes         warnings about a fit
profile       profiles of chi squared, confidence intervals
posterior     draws from the posterior distribution
result        `Fit`: the result, with all of these
problem       `FitProblem` and `fit`: from the arguments to the result
comparison    `compare`: several models of the same data
standard      the usual models of a stack
files         a problem from a TOML file
tables        drops, and what was measured of each, from a CSV file
question      a problem from texts, as typed beside a file
============= ====================================================================
"""

from stackbounce.extras import MEASURING, need
from stackbounce.fitting.comparison import Comparison, compare
from stackbounce.fitting.files import read_question
from stackbounce.fitting.parameters import Range
from stackbounce.fitting.posterior import Posterior
from stackbounce.fitting.problem import FitProblem, Interrupted, Model, fit
from stackbounce.fitting.profile import Interval
from stackbounce.fitting.residuals import Record, Residual
from stackbounce.fitting.result import Fit
from stackbounce.fitting.standard import standard_models
from stackbounce.fitting.tables import read_drops

__all__ = [
    "Comparison",
    "Fit",
    "FitProblem",
    "Interrupted",
    "Interval",
    "Model",
    "Posterior",
    "Range",
    "Record",
    "Residual",
    "compare",
    "fit",
    "read_drops",
    "read_question",
    "standard_models",
]

need("stackbounce fit", *MEASURING)
