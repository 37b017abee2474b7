"""A drop whose numbers have errors -> speeds, heights, times and energy with errors.

=========== =====================================================================
inputs      the numbers with errors, and draws of them
draws       the runs of draws, whose work is limited; derivatives, and whether draws follow them
runs        single runs, for forces, apexes and curves in time
sensitivity which number makes how much of the variance: shares, Sobol indices
result      `Prediction`: the result, with all of these
prediction  `predict`: from the arguments to the result
scenario    the errors in a scenario file
=========== =====================================================================
"""

from stackbounce.prediction.prediction import predict
from stackbounce.prediction.result import Apex, Prediction
from stackbounce.prediction.scenario import read_scenario, write_scenario

__all__ = ["Apex", "Prediction", "predict", "read_scenario", "write_scenario"]
