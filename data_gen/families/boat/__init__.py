"""Boats: their bow points towards +z, what is lowest of them stands on the floor."""

from data_gen.families.boat.sails import SAILS
from data_gen.families.boat.ships import SHIPS
from data_gen.families.boat.small import SMALL

FAMILIES = (*SAILS, *SMALL, *SHIPS)
