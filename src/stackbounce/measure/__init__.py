"""From the files that people have to parameters with uncertainties.

=========== ========================================================================
reading/    files -> Dataset
waveform/   force waveform -> contacts, stiffness, gap
sound       recording -> knocks
bounces     times of knocks -> restitutions
few         one knock or two -> what they tell all the same
track       positions -> flights, speeds, heights
heights     bounce heights -> restitutions
press/      press curve -> stiffness, exponent, loss
stiffness   contact time -> stiffness, or the constants of any law
analysis    which of these a file needs
assembly    what was found -> a ball to drop
synthetic/  from the simulator to noisy records
=========== ========================================================================
"""

from stackbounce.measure.analysis import analyse
from stackbounce.measure.assembly import one_ball
from stackbounce.measure.bounces import bounces
from stackbounce.measure.heights import heights
from stackbounce.measure.press import press, series_stiffness, split_series
from stackbounce.measure.reading import read
from stackbounce.measure.sound import knocks
from stackbounce.measure.stiffness import dynamic_stiffness, law_constants
from stackbounce.measure.track import track
from stackbounce.measure.waveform import gap_from_delay, waveform

__all__ = [
    "analyse",
    "bounces",
    "dynamic_stiffness",
    "gap_from_delay",
    "heights",
    "knocks",
    "law_constants",
    "one_ball",
    "press",
    "read",
    "series_stiffness",
    "split_series",
    "track",
    "waveform",
]
