"""From the files that people have to parameters with uncertainties.

============= ========================================================================
reading/      files -> Dataset
waveform/     force waveform -> contacts, stiffness, gap
sound         recording -> knocks
bounces       times of knocks -> restitutions
few_bounces   one knock or two -> what they tell all the same
track         positions -> flights, speeds, heights
track_notes   what should be known of a track
heights       bounce heights -> restitutions
press/        press curve -> stiffness, exponent, loss
stiffness     contact time -> stiffness, or the constants of any law
accelerometer acceleration of what falls -> flights, restitutions
floor_gap     force on the floor with and without the upper ball -> gap
sensor_gap    forces on the floor and between the balls -> gap
analysis      which of these a file needs
told          what a file does not say: numbers of ball and drop, with units
assembly      what was found -> a law, a ball to drop
synthetic/    from the simulator to noisy records
============= ========================================================================
"""

from stackbounce.extras import need
from stackbounce.measure.analyse_file import analyse
from stackbounce.measure.assembly import one_ball, one_law
from stackbounce.measure.kinds.acceleration.analysis import accelerometer
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.gap.delay import gap_from_delay
from stackbounce.measure.kinds.gap.floor_gap import floor_gap
from stackbounce.measure.kinds.gap.sensor_gap import sensor_gap
from stackbounce.measure.kinds.heights.analysis import heights
from stackbounce.measure.kinds.press import press, series_stiffness, split_series
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.measure.kinds.track.analysis import track
from stackbounce.measure.kinds.waveform import waveform
from stackbounce.measure.law_constants import dynamic_stiffness, law_constants
from stackbounce.measure.reading import read

__all__ = [
    "accelerometer",
    "analyse",
    "bounces",
    "dynamic_stiffness",
    "floor_gap",
    "gap_from_delay",
    "heights",
    "knocks",
    "law_constants",
    "one_ball",
    "one_law",
    "press",
    "read",
    "sensor_gap",
    "series_stiffness",
    "split_series",
    "track",
    "waveform",
]

need("measure", "stackbounce measure")
