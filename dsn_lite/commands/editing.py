"""edit: a handle of a mesh is moved, and the mesh and others follow."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from tyro.conf import OmitArgPrefixes, Positional, UseAppendAction, arg

from .carrying import CARRYING, Carrying, save_mesh
from .runs import Run, space_of

if TYPE_CHECKING:
    from ..meshes import EditableMesh, Edited


@dataclass(frozen=True)
class Splitting:
    """How a mesh is taken apart."""

    by: Literal["auto", "nodes", "components"] = "auto"
    """Parts are the nodes of a scene or connected components; auto takes nodes where somebody made two or more."""
    most: int = 16
    """At most so many parts; of more, the smallest are merged to their closest neighbours."""

    def told(self) -> dict[str, Any]:
        """As meshes.EditableMesh takes it."""
        return {"by": self.by, "most": self.most}


SPLITTING = Splitting()
Pairs = UseAppendAction[tuple[str, ...]]


def edit(
    run: Run,
    mesh: Positional[Annotated[Path, arg(metavar="MESH")]],
    /,
    *,
    set: Annotated[Pairs, arg(metavar="HANDLE=VALUE")] = (),
    out: Annotated[Path | None, arg(aliases=["-o"])] = None,
    list: bool = False,
    change: bool = False,
    bounds: Annotated[Pairs, arg(metavar="HANDLE=LOW:HIGH")] = (),
    to: Annotated[UseAppendAction[tuple[Path, ...]], arg(metavar="OTHER")] = (),
    by_boxes: bool = False,
    how: OmitArgPrefixes[Carrying] = CARRYING,
    parts: OmitArgPrefixes[Splitting] = SPLITTING,
) -> None:
    """Move a handle of a mesh; the edit snaps to the plausible shapes of a space, and other meshes follow.

    A handle is a part's translation (the place of its centre) or scale (an edge of its box) along x, y or z: x points
    right, y up, z to the front; values are in the unit of the file. --list prints them all.

    Args:
        run: A run folder, or the name of a ready-made space.
        mesh: The mesh to edit (.glb, .gltf, .obj, .ply, .stl or .off).
        set: Pin a handle, or all that a pattern means: leg_1.scale.y=0.3 or leg_*.scale.y=0.3. May be repeated.
        out: The mesh to write (.glb, .obj, .ply or .stl); others get the names of their files after it. With --list,
            the mesh with a colour for each part.
        list: Print the parts and the values of their handles, and change nothing.
        change: Values are changes, not values.
        bounds: Keep a handle between two values, of which one may be left out: seat.scale.y=0.02:0.1. May be repeated.
        to: Another mesh that the same deformation is done to. May be repeated.
        by_boxes: Move each part with its box, which keeps its form, instead of vertex by vertex.
        how: How meshes are brought into the training box.
        parts: How the mesh is taken apart.
    """
    from .. import meshes  # trimesh loads slowly, and the other commands do without

    if not list and (not set or out is None):
        raise ValueError("edit: --set and -o must be given, or --list to see the handles; try --list first")
    edits = dict(_pair("--set", "HANDLE=VALUE", text, float) for text in set)
    limits = dict(_pair("--bounds", "HANDLE=LOW:HIGH", text, _ends) for text in bounds)
    told = how.told() | parts.told()
    if list:
        _show(meshes.EditableMesh(space_of(run), mesh, **told), out)
        return
    more = {"others": to, "change": change, "bounds": limits, "by_boxes": by_boxes}
    _write(meshes.edit(space_of(run), mesh, edits, **more, **told), out, to)


def _pair(where: str, form: str, text: str, value: Any) -> tuple[str, Any]:
    name, equals, after = text.rpartition("=")
    try:
        if not (name and equals):
            raise ValueError
        return name, value(after)
    except ValueError:
        raise ValueError(f"{where}: must be {form}, got {text}; see --list for the handles") from None


def _ends(text: str) -> tuple[float | None, float | None]:
    low, high = text.split(":")
    return float(low) if low else None, float(high) if high else None


def _show(mesh: "EditableMesh", out: Path | None) -> None:
    """One row a part: where it is and how large."""
    wide, largest = max(map(len, mesh.parts.names)), max(map(abs, mesh.values.values()))
    heads = [f"{kind}.{axis}" for kind in ("translation", "scale") for axis in "xyz"]
    print(f"{'part':<{wide}}  " + " ".join(f"{head:>13}" for head in heads))
    for part in mesh.parts.names:
        found = [_said(mesh.values.get(f"{part}.{head}"), largest) for head in heads]
        print(f"{part:<{wide}}  " + " ".join(f"{value:>13}" for value in found))
    if out is not None:
        save_mesh(mesh.coloured(), out)


def _said(value: float | None, largest: float) -> str:
    """Four digits; - for a handle that is not there, 0 for what is only rounding."""
    return "-" if value is None else f"{value if abs(value) > 1e-9 * largest else 0:.4g}"


def _write(edited: "Edited", out: Path, to: tuple[Path, ...]) -> None:
    snapped = edited.snapped
    save_mesh(edited.mesh, out)
    for other, name in zip(edited.others, _names(out, to), strict=True):
        save_mesh(other, name)
    print(f"the snap went {snapped.distance:.4g} (root mean square, in the unit of the file)")
    for name in snapped.pinned:
        before = snapped.z0[snapped.names.index(name)].item()
        print(f"{name}: {before:.4g} -> {snapped[name]:.4g}")
    if snapped.at_bounds:
        print(f"held at a bound: {', '.join(snapped.at_bounds)}", file=sys.stderr)


def _names(out: Path, to: tuple[Path, ...]) -> list[Path]:
    """out_chair.glb for chair.obj, with a number where two would be the same."""
    stems = [path.stem for path in to]
    marks = ["" if stems.count(stem) == 1 else f"_{i}" for i, stem in enumerate(stems, 1)]
    return [out.with_name(f"{out.stem}_{stem}{mark}{out.suffix}") for stem, mark in zip(stems, marks, strict=True)]
