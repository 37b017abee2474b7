"""Measured drops -> parameters with uncertainties, and a comparison of models.

The files in the order of their imports:

============= ====================================================================
quantities    what can be measured of a drop, and how it follows from a run
waveforms     force records as data
measurements  what was measured of a drop, with errors
formula       the formulas of ties
parameters    what is varied, with bounds and priors
ties          what follows from what is varied
objective     residuals and chi squared of many trials at once, and the best trial so far
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
rows          the rows of a table with words in it
tables        drops, and what was measured of each, from a CSV file
question      a problem from texts, as typed beside a file
series/       contact laws beside restitutions at several speeds
cite          a paragraph on a fit for a paper, and what it cites
============= ====================================================================
"""

from stackbounce.extras import MEASURING, need
from stackbounce.fitting.comparison import Comparison as Comparison
from stackbounce.fitting.comparison import compare as compare
from stackbounce.fitting.files import read_question as read_question
from stackbounce.fitting.parameters import Range as Range
from stackbounce.fitting.posterior import Posterior as Posterior
from stackbounce.fitting.problem import FitProblem as FitProblem
from stackbounce.fitting.problem import Interrupted as Interrupted
from stackbounce.fitting.problem import Model as Model
from stackbounce.fitting.problem import fit as fit
from stackbounce.fitting.profile import Interval as Interval
from stackbounce.fitting.residuals import Record as Record
from stackbounce.fitting.residuals import Residual as Residual
from stackbounce.fitting.result import Fit as Fit
from stackbounce.fitting.standard import standard_models as standard_models
from stackbounce.fitting.tables import read_drops as read_drops

need("stackbounce fit", *MEASURING)
