"""Figures of the course: shapes side by side in one 3D view, offset fields, laws, training curves, spectra.

Every function but `picture` returns a plotly Figure: equal axes, white background, text of 14 pt and more, colours of
Okabe and Ito without the pale yellow. Each carries a sentence of alternative text, `plots.alt(figure)`, which exported
pages give to screen readers. Importing this module inside Jupyter makes figures appear in exported HTML too, without a
network.
"""

from .charts import curve, spectrum
from .dictionaries import mode_heat, mode_on_shapes, paired_bars
from .images import picture
from .laws import axiom_bars
from .look import alt, appear_when_exported
from .plane import plane
from .scenes import compare, modes, offsets, shapes
from .solids import meshes
from .tables import bars, law_table, lines
from .together import together

__all__ = [
    "alt",
    "axiom_bars",
    "bars",
    "compare",
    "curve",
    "law_table",
    "lines",
    "meshes",
    "mode_heat",
    "mode_on_shapes",
    "modes",
    "offsets",
    "paired_bars",
    "picture",
    "plane",
    "shapes",
    "spectrum",
    "together",
]

appear_when_exported()
