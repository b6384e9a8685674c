"""Widgets for Jupyter: sliders over families, dictionaries and thresholds, a deformation, a training to watch.

They draw with plotly through one class, `Canvas`, and work without a front end, so that lessons can be tested.
"""

from .canvas import Canvas
from .families import FamilySliders
from .heartbeat import heartbeat
from .live import LiveTraining
from .path import DeformationPath
from .sliders import DictionarySliders
from .threshold import ThresholdSlider

__all__ = [
    "Canvas",
    "DeformationPath",
    "DictionarySliders",
    "FamilySliders",
    "LiveTraining",
    "ThresholdSlider",
    "heartbeat",
]
