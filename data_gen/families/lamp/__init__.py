"""Lamps: on the floor, on a table, below the ceiling. Their shades are hollow."""

from data_gen.families.lamp import hanging, standing, table

FAMILIES = standing.FAMILIES + table.FAMILIES + hanging.FAMILIES
