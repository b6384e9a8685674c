"""Airplanes: they fly at y = 0, their nose towards +z."""

from data_gen.families.airplane.large import LARGE
from data_gen.families.airplane.light import LIGHT
from data_gen.families.airplane.other import OTHER

FAMILIES = (*LARGE, *LIGHT, *OTHER)
