"""A drop whose numbers have errors -> speeds, heights, times and energy with errors.

=========== =====================================================================
inputs      the numbers with errors, and draws of them
draws       runs of draws, whose work is limited, and derivatives; single runs;
            which number makes how much of the variance
result      `Prediction`: the result, with all of these
prediction  `predict`: from the arguments to the result
=========== =====================================================================
"""

from stackbounce.prediction.prediction import predict, read_scenario
from stackbounce.prediction.result import Apex, Prediction

__all__ = ["Apex", "Prediction", "predict", "read_scenario"]
