"""The parameters of a category: a name means one thing in all its families, and has a range in each."""

from data_gen.rig import Parameter


def ranges(meanings, **bounds):
    """A Parameter for each name=(low, high), with its meaning from a dictionary: lengths all."""
    return tuple(Parameter(name, low, high, meanings[name]) for name, (low, high) in bounds.items())
