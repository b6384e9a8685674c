"""A person edits one handle of one shape: the broken edit, the snapped shape, and others that follow (Section 4.1)."""

from collections.abc import Mapping, Sequence
from html import escape
from itertools import chain, repeat
from typing import Any

import ipywidgets
import torch
from jaxtyping import Float
from torch import Tensor

from ..editing import CoEdit, History
from ..editing.followers import Others, each
from ..handles import corners
from ..modes.kinds import kind, kinds
from ..plots.look import GREY, PALETTE
from ..projection import Prior
from ..shapes import Shapes
from ..space import ActionSpace
from .canvas import Canvas
from .guard import Notice
from .picking import HandlePicker, spoken


class HandleEditor(ipywidgets.VBox):
    """Pick a part and a handle of a shape, move the slider: the edit as it is, snapped, and others that follow it.

    Arguments as of History, `titles` one a follower. `name` is the handle that is picked, `value` where its slider
    stands; both can be set. One drag is one edit of `history`, from where the edit before ended; `strength` is how far
    the others follow the latest. Raises ValueError as History does, and where there is no other shape.
    """

    def __init__(
        self,
        space: ActionSpace,
        source: Shapes,
        others: Others,
        prior: Prior | None = None,
        *,
        titles: Sequence[str] | None = None,
    ):
        followers = list(each(others))
        if not followers:
            raise ValueError("HandleEditor: there must be at least one other shape, got none; take some")
        self.history = History(space, source, followers, prior)
        self.notice, self.told = Notice(), Notice()
        self._before, self._live = self.state, False  # where the latest drag began, and whether it still goes on
        self.picker = HandlePicker(self._handles, self.notice.guard(self._pick), self.notice.guard(self._slide))
        self.strength = _slider("strength", 1.0, 0.0, 2.0, "how far the others follow, 1 as far as the source")
        self.strength.observe(self.notice.guard(self._strengthen), "value")
        self.hold = ipywidgets.Checkbox(description="hold what was edited before", indent=False)
        steps = {"undo": self._undo, "redo": self._redo, "reset": self._reset}
        self.buttons = {name: ipywidgets.Button(description=name, layout={"width": "80px"}) for name in steps}
        for name, button in self.buttons.items():
            button.on_click(self.notice.guard(steps[name]))
        colours = _colours([source, *followers])
        own, found = self.state.source, [one.points for one in self.state.others]
        self.canvas = Canvas(
            [own.points] * 2,
            labels=colours[:1] * 2,
            titles=["your edit", "snapped"],
            boxes=self._boxes(own.z_hat),
            room=1.25,
        )
        self.others = Canvas(found, labels=colours[1:], titles=titles, boxes=self._others_boxes(), room=1.15)
        row = ipywidgets.HBox([*self.buttons.values(), self.hold], layout={"flex_flow": "row wrap"})
        controls = [self.picker, self.strength, row, self.told, self.notice]
        super().__init__([*controls, self.canvas.view, self.others.view, _key([source, *followers])])
        self._show()

    @property
    def state(self) -> CoEdit:
        """Where the edits have led: source and others."""
        return self.history.state

    @property
    def name(self) -> str:
        """The handle that is picked, such as leg_2.scale.y."""
        return self.picker.name

    @name.setter
    def name(self, name: str) -> None:
        self.picker.name = name

    @property
    def value(self) -> float:
        """Where its slider stands."""
        return self.picker.value

    @value.setter
    def value(self, value: float) -> None:
        self.picker.value = value

    @property
    def _handles(self) -> Any:
        return self.history.editor.handles

    def _pick(self, _change: Any) -> None:
        """Another handle: the next drag starts where all edits have led."""
        self._before, self._live = self.state, False
        self._draw()

    def _slide(self, _change: Any) -> None:
        """While a slider moves, it is one edit, told anew."""
        done = self.history.done[:-1] if self._live else self.history.done
        earlier = {name for step in done for name in step.edits} if self.hold.value else ()
        held = {name: self._before.source[name] for name in earlier}
        self._tell({**held, self.name: self.value}, instead=self._live)
        self._live = True
        self._draw()

    def _strengthen(self, _change: Any) -> None:
        """The latest edit with another strength."""
        if self.history.done:
            self._tell(self.history.done[-1].edits, instead=True)
            self._draw()

    def _tell(self, edits: Mapping[str, float], instead: bool) -> None:
        """One more edit, or one instead of the latest; one that is refused leaves all as it was."""
        if instead:
            self.history.undo()
        try:
            self.history.do(edits, strength=self.strength.value)
        except Exception:
            if instead:
                self.history.redo()
            raise

    def _undo(self, _button: Any) -> None:
        self.history.undo()
        self._pick(None)

    def _redo(self, _button: Any) -> None:
        self.history.redo()
        self._pick(None)

    def _reset(self, _button: Any) -> None:
        while self.history.done:
            self.history.undo()
        self._pick(None)

    def _boxes(self, broken: Float[Tensor, " m"]) -> dict[int, Tensor]:
        """The one box that is edited, where values are `broken`, and all boxes as they were snapped."""
        row = self.picker.row
        return {0: corners(self._handles, broken)[row : row + 1], 1: corners(self._handles, self.state.source.z_hat)}

    def _others_boxes(self) -> dict[int, Tensor]:
        pairs = enumerate(zip(self.history.editor.followers, self.state.others, strict=True))
        return {i: corners(who.handles, now.z_hat) for i, (who, now) in pairs if who.handles is not None}

    def _draw(self) -> None:
        source, broken = self.state.source, self._before.source.z_hat.clone()
        if self._live:
            broken[source.names.index(self.name)] = self.value
        edited = source.edited if self._live else source.points
        self.canvas.update_all({0: edited, 1: source.points}, self._boxes(broken))
        self.others.update_all({i: one.points for i, one in enumerate(self.state.others)}, self._others_boxes())
        self._show()

    def _show(self) -> None:
        """What controls and words tell."""
        if not self._live:
            self.picker.show(self.state.source[self.name])
        self.buttons["undo"].disabled, self.buttons["redo"].disabled = not self.history.done, not self.history.undone
        self.buttons["reset"].disabled = not self.history.done
        self.told.say(self._said())

    def _said(self) -> str:
        """What the latest edit did, in words."""
        if not self.history.done:
            return f"Nothing is edited yet. {spoken(self.name)} is at {self.value:.3f}."
        source, step = self.state.source, self.history.done[-1]
        pins = ", ".join(f"{spoken(name)} at {value:.3f}" for name, value in step.edits.items())
        met = ", ".join(map(spoken, source.at_bounds[:3])) or "no bound"
        more = f" and {len(source.at_bounds) - 3} more" if len(source.at_bounds) > 3 else ""
        moved = ", ".join(f"{one.moved:.3f}" for one in self.state.others)
        return (
            f"Edit {len(self.history.done)}: {pins}. The snap moved points by {source.distance:.3f}, met {met}{more}. "
            f"Since the start the source moved by {self.state.moved:.3f}, the others by {moved} (all rms)."
        )


def _slider(name: str, value: float, low: float, high: float, told: str) -> ipywidgets.FloatSlider:
    return ipywidgets.FloatSlider(
        value=value,
        min=low,
        max=high,
        step=(high - low) / 20,
        description=name,
        tooltip=f"{told}, arrow keys work",
        style={"description_width": "70px"},
        layout={"width": "530px"},
    )


def _kinds(shapes: Sequence[Shapes]) -> tuple[str, ...]:
    """The kinds of parts that these shapes have points of."""
    own = [one.part_names[label] for one in shapes if one.has_parts for label in one.labels.unique() if label >= 0]
    return kinds(own)


def _colours(shapes: Sequence[Shapes]) -> list[Tensor | None]:
    """For each point the kind of its part, so that one colour means one kind on all shapes; kinds beyond are grey."""
    places = {name: i for i, name in enumerate(_kinds(shapes)[: len(PALETTE)])}
    rows = [[places.get(kind(name), -1) for name in one.part_names] for one in shapes]
    return [
        torch.tensor([*row, -1])[one.labels.long().flatten()] if one.has_parts else None
        for one, row in zip(shapes, rows, strict=True)
    ]


def _key(shapes: Sequence[Shapes]) -> ipywidgets.HTML:
    """The colour of each kind of part."""
    named = [
        f"<span style='white-space:nowrap'><span style='color:{colour}'>&#9632;</span> "
        f"{escape(name.replace('_', ' '))}</span>"
        for name, colour in zip(_kinds(shapes), chain(PALETTE, repeat(GREY)), strict=False)
    ]
    return ipywidgets.HTML(" &ensp; ".join(named))
