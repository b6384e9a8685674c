"""A session of edits on one source: done, undone, done again, replayed, kept in a file."""

from collections.abc import Mapping
from pathlib import Path

from ..projection import Prior
from ..projection.bounds import Bounds
from ..shapes import Shapes
from ..space import ActionSpace
from .blending import CoEdit
from .coeditor import CoEditor
from .followers import Others
from .keeping import check_end, identity, read, write
from .steps import Step


class History:
    """Edits of one source, each from where the last one ended, with others that follow; arguments as of CoEditor.

    `state` is where they have led so far. Undo goes back to states that were kept, bit by bit; a new edit drops those
    that were undone. `done` and `undone` are the edits as they were told.
    """

    def __init__(self, space: ActionSpace, source: Shapes, others: Others = (), prior: Prior | None = None):
        self.editor = CoEditor(space, source, others, prior)
        self._identity = identity(space, source, prior)
        self._steps: list[Step] = []
        self._states = [self.editor.start]
        self._cursor = 0

    @property
    def state(self) -> CoEdit:
        """Source and others as they stand now."""
        return self._states[self._cursor]

    @property
    def done(self) -> tuple[Step, ...]:
        """The edits that the state holds, first to last."""
        return tuple(self._steps[: self._cursor])

    @property
    def undone(self) -> tuple[Step, ...]:
        """The edits that `redo` would do, next to last."""
        return tuple(self._steps[self._cursor :])

    def do(
        self,
        edits: Mapping[str, float],
        *,
        change: bool = False,
        bounds: Bounds | None = None,
        strength: float = 1.0,
    ) -> CoEdit:
        """One more edit; arguments and errors as of CoEditor, and an edit that is refused leaves all as it was."""
        state = self.preview(edits, change=change, bounds=bounds, strength=strength)
        step = Step.told(edits, change, bounds or {}, strength)
        self._steps[self._cursor :], self._states[self._cursor + 1 :] = [step], [state]
        self._cursor += 1
        return state

    def preview(
        self,
        edits: Mapping[str, float],
        *,
        change: bool = False,
        bounds: Bounds | None = None,
        strength: float = 1.0,
    ) -> CoEdit:
        """What `do` would give, without doing it: for every frame of a drag, before it ends."""
        return self.editor(edits, change=change, bounds=bounds, strength=strength, after=self.state)

    def undo(self) -> CoEdit:
        """The state before the last edit. Raises ValueError where none is left."""
        if not self.done:
            raise ValueError("undo: there must be an edit to take back, got none; look at `done` first")
        self._cursor -= 1
        return self.state

    def redo(self) -> CoEdit:
        """The edit that was undone last, done again. Raises ValueError where none was."""
        if not self.undone:
            raise ValueError("redo: there must be an undone edit, got none; look at `undone` first")
        self._cursor += 1
        return self.state

    def replay(self) -> tuple[CoEdit, ...]:
        """The unmoved shapes and then the state after each edit done, computed again from the edits alone."""
        states = [self.editor.start]
        for step in self.done:
            states.append(self.editor(**vars(step), after=states[-1]))
        return tuple(states)

    def save(self, path: str | Path) -> None:
        """Writes the edits, done and undone, as JSON, with what identifies the space and the source.

        The others are not kept: the same edits may be opened beside any.
        """
        write(Path(path), self._identity, self._steps, self._cursor, self._states[-1].source)

    @classmethod
    def load(
        cls,
        path: str | Path,
        space: ActionSpace,
        source: Shapes,
        others: Others = (),
        prior: Prior | None = None,
    ) -> "History":
        """A saved history of this space and source: the same bits on the same machine, undone edits and all.

        Raises FileNotFoundError or ValueError in one sentence: no such file, no whole JSON, of another format, changed
        by hand, of another space or source, or edits that no longer lead to the handle values that the file tells.
        """
        history, path = cls(space, source, others, prior), Path(path)
        steps, cursor, z_hat = read(path, history._identity)
        for step in steps:
            history.do(**vars(step))
        check_end(path, z_hat, history.state.source)
        history._cursor = cursor
        return history
