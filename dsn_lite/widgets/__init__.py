"""Widgets for Jupyter: sliders over families, dictionaries, handles and thresholds, a deformation, a live training.

They draw with plotly through one class, `Canvas`, and work without a front end, so that lessons can be tested.
"""

from .canvas import Canvas
from .coediting import HandleEditor
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
    "HandleEditor",
    "LiveTraining",
    "ThresholdSlider",
    "heartbeat",
]
