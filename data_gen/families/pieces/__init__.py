"""Pieces that families of several categories are made of."""
