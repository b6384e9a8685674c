"""The laws of a space as bars on a logarithmic axis that has a place for 0."""

from math import floor, log10

import plotly.graph_objects as go

from ..axioms import LAWS, Report
from .look import BLACK, BLUE, GREEN, GREY, LINES, PURPLE, VERMILLION, dress

# colour and pattern, so that neither is needed alone
KINDS = {"construction": ("holds by construction", BLUE, ""), "learning": ("holds by learning", VERMILLION, "/")}
KNOW_NOTHING = {
    "untrained": ("untrained space", {"symbol": "diamond-open", "color": BLACK}),
    "do_nothing": ("space that does nothing", {"symbol": "x-thin", "line": {"width": 3, "color": PURPLE}}),
}
EARLIER = {"symbol": "circle-open", "color": GREEN, "line": {"width": 3}}
LEGEND = {"orientation": "h", "x": 0, "xanchor": "left", "y": 1.02, "yanchor": "bottom"}
TITLE = {"text": "residual, rms (dotted: typical distance of two shapes)", "standoff": 12}


def axiom_bars(report: Report, before: Report | None = None) -> go.Figure:
    """The residuals of the seven laws, rms in the unit of the shapes, as bars on a log axis that begins at 0.

    Bars differ in colour and pattern by what they hold by; the residuals stand on the right. Marks show what the
    untrained and the do-nothing space score, and `before`, another report, what this space scored earlier. A dotted
    line stands at the typical distance of two shapes: a learned law with that residual was not learned.
    """
    marks = {
        name: ({row.law: getattr(row, of) for row in report.rows}, mark) for of, (name, mark) in KNOW_NOTHING.items()
    }
    if before is not None:
        marks = {"before training": ({row.law: row.residual for row in before.rows}, EARLIER)} | marks
    shown = [report.spread, *(row.residual for row in report.rows)]
    shown += [value for values, _ in marks.values() for value in values.values()]
    first, last = decades(shown)
    zero = 10.0 ** (first - 1.5)  # where 0 is drawn: a decade and a half before the first power of ten
    figure = go.Figure([_bars(report, kind, zero) for kind in KINDS])
    figure.add_traces([_marks(values, name, mark, zero) for name, (values, mark) in marks.items()])
    figure.add_vline(report.spread, line={"dash": "dot", "color": GREY})
    figure.update_layout(annotations=[_written(row.law, row.residual) for row in report.rows])
    figure.update_layout(legend=LEGEND, barmode="overlay", bargap=0.35, margin={"l": 20, "r": 110, "t": 90, "b": 80})
    figure.update_xaxes(type="log", title=TITLE, gridcolor=LINES, zeroline=False, **_ticks(zero, first, last))
    order = [_name(law) for law in reversed(LAWS)]
    figure.update_yaxes(categoryorder="array", categoryarray=order, automargin=True, ticksuffix="  ")
    return dress(figure, _said(report), width=860, height=610)


def decades(values: list[float]) -> tuple[int, int]:
    """The powers of ten below the least positive and above the largest of the values."""
    positive = [value for value in values if value > 0] or [1.0]
    return floor(log10(min(positive))), floor(log10(max(positive))) + 1


def _bars(report: Report, kind: str, zero: float) -> go.Bar:
    name, colour, pattern = KINDS[kind]
    rows = [row for row in report.rows if row.kind == kind]
    return go.Bar(
        y=[_name(row.law) for row in rows],
        x=[max(row.residual - zero, 0) for row in rows],
        base=zero,
        orientation="h",
        name=name,
        marker={"color": colour, "pattern": {"shape": pattern, "fillmode": "overlay", "fgcolor": "white", "size": 9}},
        hoverinfo="skip",
    )


def _marks(values: dict[str, float], name: str, mark: dict, zero: float) -> go.Scatter:
    return go.Scatter(
        y=[_name(law) for law in values],
        x=[max(value, zero) for value in values.values()],
        mode="markers",
        name=name,
        marker={"size": 13, **mark},
        cliponaxis=False,
        hovertemplate="%{y}: %{x:.1e}<extra>" + name + "</extra>",
    )


def _written(law: str, residual: float) -> dict:
    """A residual as text, right of the plot, where no mark covers it."""
    text = "0" if residual == 0 else f"{residual:.1e}"
    place = {"x": 1.02, "xref": "paper", "xanchor": "left", "y": _name(law), "yref": "y"}
    return place | {"text": text, "showarrow": False}


def _ticks(zero: float, first: int, last: int) -> dict:
    powers = range(first, last + 1, 1 + (last - first) // 6)
    places = {"tickvals": [zero, *(10.0**power for power in powers)]}
    names = {"ticktext": ["0", *(f"10<sup>{power}</sup>" for power in powers)]}
    return places | names | {"range": [log10(zero) - 0.03 * (last - first), last]}


def _name(law: str) -> str:
    return f"{law.replace('_', ' ')}<br><span style='color:{GREY}'>{LAWS[law].replace('(+)', '⊕')}</span>"


def _said(report: Report) -> str:
    learned = [row for row in report.rows if row.kind == "learning"]
    if not learned:
        return f"Residuals of {len(report.rows)} laws, all of them held by construction."
    worst = max(learned, key=lambda row: row.residual)
    return (
        f"Residuals of {len(report.rows)} laws on a logarithmic axis. The largest of the learned ones: "
        f"{worst.law.replace('_', ' ')}, {worst.residual:.1e}."
    )
