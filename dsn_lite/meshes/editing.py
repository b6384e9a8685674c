"""A person moves a handle of a mesh; the edit snaps to what the space holds plausible, and others follow (Eqs. 4-7)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import torch

from ..projection import EditProjector, Snapped
from ..space import ActionSpace
from .boxes import boxes_of, rest_of
from .bringing import Shape, brought, frame_of, opened_mesh, split_edges
from .carrying import moved, painted, separate
from .holding import dictionary_at, handles_at, held, turned
from .moving import field
from .parts import split
from .surface import Mesh, places


@dataclass(frozen=True)
class Edited:
    """A mesh after an edit, what the projection found, and the other meshes that were given, each (+) the same v.

    Handle values, points and distances of `snapped` are in the unit of the file; x points right, y up and z to the
    front, whatever the axes of the file.
    """

    mesh: Mesh
    snapped: Snapped
    others: tuple[Mesh, ...] = ()


class EditableMesh:
    """A mesh with handles: prepared once, then edited again and again, always from its form as it was.

    `parts`, `handles` (names like leg_2.scale.y, also where they are bounded) and `values`, each handle's value in the
    unit of the file. Arguments, axes and errors are those of `edit`.
    """

    def __init__(
        self,
        space: ActionSpace,
        mesh: Shape,
        *,
        up: str = "auto",
        by: str = "auto",
        most: int = 16,
        subdivide: float | None = None,
        seed: int = 0,
    ):
        frame = frame_of(space, "edit")
        self.space, self.mesh = space, separate(split_edges(opened_mesh(mesh, "edit"), subdivide, "edit"))
        self.parts = split(self.mesh, by=by, most=most)
        self.there, self.cloud = brought(frame, self.mesh, _ups(up, 1)[0], seed, "edit")
        vertices = turned(self.there, places(self.mesh))
        boxes = boxes_of(vertices, self.parts.vertices, len(self.parts))
        points, labels = held(self.mesh, self.parts, frame.n, seed)
        x = turned(self.there, points)
        self.handles = handles_at(x, labels, boxes, self.parts.names)
        at = self.parts.vertices
        self.of_vertices = self.handles.at(torch.from_numpy(at), torch.from_numpy(rest_of(vertices, at, boxes)))
        # the dictionary in the unit of the file, so that values, bounds and distances are in it too
        A = dictionary_at(space, self.cloud, self.there.apply(points)) / self.there.scale
        self.projector = EditProjector(A, self.handles, torch.from_numpy(x))

    @property
    def values(self) -> dict[str, float]:
        """The value of every handle as the mesh stands, in the unit of its file."""
        return dict(zip(self.handles.names, self.handles.z0.tolist(), strict=True))

    def coloured(self) -> Mesh:
        """A copy in which every part has a colour of its own instead of materials, to see which is which."""
        return painted(self.mesh, self.parts.vertices)

    def edit(
        self,
        edits: Mapping[str, float],
        *,
        change: bool = False,
        bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
        by_boxes: bool = False,
    ) -> Edited:
        """Pins handles and moves the mesh by A v, or with by_boxes by B z_hat, which keeps each part's own form."""
        snapped = self.projector(edits, change=change, bounds=bounds)
        if not by_boxes:
            return Edited(moved(self.mesh, field(self.space, self.there, self.cloud, snapped.v)), snapped)
        offsets = self.of_vertices.offsets(snapped.z_hat - snapped.z0).numpy() @ self.there.rotation
        return Edited(moved(self.mesh, lambda _: offsets), snapped)


def edit(
    space: ActionSpace,
    mesh: Shape,
    edits: Mapping[str, float],
    *,
    others: Sequence[Shape] = (),
    change: bool = False,
    bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
    by_boxes: bool = False,
    up: str | Sequence[str] = "auto",
    by: str = "auto",
    most: int = 16,
    subdivide: float | None = None,
    seed: int = 0,
) -> Edited:
    """Snaps an edit of a mesh, {"leg_2.scale.y": 0.3}: faces, names, colours, materials and UVs stay; vertices move.

    A handle is a translation (the place of a part's centre) or a scale (the length of its box's edge) along an axis of
    the box of a part, and is told in the unit of the file: values, or with change=True differences. Axis x points
    right, y up and z to the front, also where up is z in the file. The code of the mesh is read from samples of its
    surface and the edit is projected there; the dictionary is then evaluated at the vertices. by_boxes moves each part
    of the mesh by its box instead: crisp parts, but not what the network draws. Each of `others` gets the same v.

    bounds: lowest and highest values by name or pattern. by, most: how `parts.split` finds parts. up, subdivide, seed:
    as for `transfer`; `up` is one word, or one for the mesh and one for each of the others.

    Raises:
        TypeError: the space is no trained DeformSyncNet, or what should move is no mesh.
        ValueError: what `transfer`, `split` and EditProjector refuse: no parts, no such handle, bounds in conflict.
    """
    ups = _ups(up, 1 + len(others))
    opened = [opened_mesh(other, "edit") for other in others]  # before the work: a wrong path is told at once
    editable = EditableMesh(space, mesh, up=ups[0], by=by, most=most, subdivide=subdivide, seed=seed)
    edited = editable.edit(edits, change=change, bounds=bounds, by_boxes=by_boxes)
    frame, v = frame_of(space, "edit"), edited.snapped.v
    followed = [
        moved(split_edges(other, subdivide, "edit"), field(space, *brought(frame, other, axis, seed, "edit"), v))
        for other, axis in zip(opened, ups[1:], strict=True)
    ]
    return Edited(edited.mesh, edited.snapped, tuple(followed))


def _ups(up: str | Sequence[str], count: int) -> list[str]:
    ups = [up] * count if isinstance(up, str) else list(up) * (count if len(up) == 1 else 1)
    if len(ups) != count or not set(ups) <= {"auto", "y", "z"}:
        raise ValueError(
            f'edit: up must be "auto", "y" or "z", once or once for each of the {count} meshes, got {up!r}; try "auto"'
        )
    return ups
