"""What all figures share: colours, type, the sentence for those who do not see them, and how they reach a page."""

import plotly.graph_objects as go
import plotly.io as pio

# Okabe and Ito (2008), which most colour-blind readers can tell apart, without the yellow that is pale on white
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY, BLACK = PALETTE = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
    "#000000",
)
GREY = "#8A8A8A"
LINES = "#DDDDDD"
TEXT = "#222222"
FONT = {"size": 19, "color": TEXT, "family": "Open Sans, Helvetica, Arial, sans-serif"}  # 19 px are 14 pt

SPEAK = """
const plot = document.getElementById("{plot_id}"), said = plot.layout && plot.layout.meta && plot.layout.meta.alt;
if (said) { plot.setAttribute("role", "img"); plot.setAttribute("aria-label", said); }
"""


def dress(figure: go.Figure, said: str, *, width: int, height: int) -> go.Figure:
    """The figure in the look of the course, with `said` as its alternative text; width and height in pixels."""
    return figure.update_layout(
        width=width,
        height=height,
        template="none",
        font=FONT,
        paper_bgcolor="white",
        plot_bgcolor="white",
        uirevision="kept",  # the reader's view stays when data change
        meta={"alt": said},
    )


def alt(figure: go.Figure) -> str:
    """The alternative text of a figure of this module: one sentence that says what is to be seen."""
    return figure.layout.meta["alt"]


def appear_when_exported() -> None:
    """Figures in Jupyter also as HTML, with plotly.js once a notebook: the default leaves exported pages blank."""
    pio.renderers["notebook"].post_script = SPEAK
    if pio.renderers.default == "plotly_mimetype":  # plotly's choice in Jupyter; a reader's own choice is kept
        pio.renderers.default = "plotly_mimetype+notebook"
