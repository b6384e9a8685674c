import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from worlds import FAMILIES, near, randn, shapes_of, unchecked

from dsn_lite.data import Shapes
from dsn_lite.dictionary import matrix
from dsn_lite.handles import BoxHandles, DenseHandles


def rotations(seed, P):
    """P random rotations."""
    Q = torch.linalg.qr(randn(seed, P, 3, 3)).Q
    return Q * torch.linalg.det(Q)[:, None, None]


def boxed(seed, P=3, n=40, loose=0, flat=None, scale=1.0):
    """Points on rotated boxes, and their handles; `loose` points have no part, part 0 is flat along the axis `flat`."""
    rest = torch.from_numpy(randn(seed, n, 3).numpy()).clamp(-1, 1) / 2
    labels = torch.arange(n) % P
    labels[:loose] = -1
    if flat is not None:
        rest[labels == 0, flat] = 0.5
    boxes = torch.cat([randn(seed + 1, P, 3), rotations(seed + 2, P).flatten(1), 0.1 + randn(seed + 3, P, 3).abs()], 1)
    boxes[:, :3] *= scale
    boxes[:, 12:] *= scale
    R = boxes[labels, 3:12].unflatten(-1, (3, 3))
    points = boxes[labels, :3] + (R @ (boxes[labels, 12:] * rest).unsqueeze(-1)).squeeze(-1)
    return points, BoxHandles(labels, rest, boxes)


@st.composite
def worlds(draw):
    """What `boxed` takes: part counts, loose points, flat parts and scales are drawn."""
    seed, P = draw(st.integers(0, 999)), draw(st.integers(1, 4))
    loose, flat = draw(st.sampled_from([0, 5])), draw(st.sampled_from([None, 0, 1, 2]))
    scale = draw(st.sampled_from([1e-2, 1.0, 1e2]))
    return {"seed": seed, "P": P, "n": 12 * P, "loose": loose, "flat": flat, "scale": scale}


@given(worlds())
def test_points_are_B_z0_and_offsets_never_form_B(world):
    scale, (points, handles) = world["scale"], boxed(**world)
    held = handles.labels >= 0
    dense = torch.einsum("ncm,m->nc", handles.B, handles.z0)
    near(dense[held], points[held], scale=scale)
    near(handles.offsets(handles.z0), dense, scale=scale)
    assert (dense[~held] == 0).all()


@given(worlds())
def test_coordinates_are_those_of_the_dense_pseudo_inverse(world):
    handles = boxed(**world)[1]
    u = randn(0, *handles.rest.shape)
    near(handles.coordinates(u), torch.linalg.pinv(matrix(handles.B)) @ u.flatten())


@given(worlds())
def test_projection_is_the_dense_one_and_leaves_loose_points(world):
    handles = boxed(**world)[1]
    u, B = randn(0, *handles.rest.shape), matrix(handles.B)
    dense = (B @ (torch.linalg.pinv(B) @ u.flatten())).unflatten(0, u.shape)
    near(handles.project(u), torch.where(handles.labels[:, None] >= 0, dense, u))


@given(worlds())
def test_projecting_twice_is_projecting_once(world):
    handles = boxed(**world)[1]
    once = handles.project(randn(0, *handles.rest.shape))
    near(handles.project(once), once)


@given(worlds())
def test_a_dictionary_is_projected_column_by_column(world):
    handles = boxed(**world)[1]
    A = randn(0, *handles.rest.shape, 4)
    near(handles.coordinates(A), torch.stack([handles.coordinates(A[..., j]) for j in range(4)], dim=-1))
    near(handles.project(A), torch.stack([handles.project(A[..., j]) for j in range(4)], dim=-1))


def test_gradients_are_those_of_the_dense_projection():
    _, handles = boxed(0, loose=4, flat=1)
    u, weight, B = randn(0, 40, 3).requires_grad_(), randn(1, 40, 3), matrix(handles.B)
    held = handles.labels[:, None] >= 0
    dense = torch.where(held, (B @ (torch.linalg.pinv(B) @ u.flatten())).unflatten(0, u.shape), u)
    near(*(torch.autograd.grad((each * weight).sum(), u)[0] for each in (handles.project(u), dense)))


def test_positions_give_z0_and_changes_give_changes():
    points, handles = boxed(0)
    near(handles.coordinates(points), handles.z0)
    change = randn(5, len(handles.names))
    near(handles.coordinates(handles.offsets(change)), change)


def test_a_handle_does_what_its_name_says():
    _, handles = boxed(0)
    R = handles.rotation[1]
    for name, local in (("translation", torch.ones(40)), ("scale", handles.rest[:, 1])):
        z = torch.zeros(len(handles.names)).double()
        z[handles.names.index(f"part_1.{name}.y")] = 1
        expected = torch.where((handles.labels == 1)[:, None], local[:, None] * R[:, 1], 0)
        near(handles.offsets(z), expected.double())


def test_a_flat_part_has_no_scale_across_and_says_so():
    points, handles = boxed(0, flat=1)
    assert handles.dropped == ("part_0.scale.y",)
    assert len(handles.names) == 3 * 6 - 1
    near(handles.coordinates(points), handles.z0)


def test_a_part_without_points_has_no_handles_even_if_its_box_is_unknown():
    boxes = torch.full((2, 15), float("nan")).double()
    boxes[0] = torch.cat([torch.zeros(3), torch.eye(3).flatten(), torch.ones(3)])
    handles = BoxHandles(torch.zeros(30).long(), randn(0, 30, 3), boxes, ("top", "leg"))
    assert handles.dropped == tuple(f"leg.{kind}.{axis}" for kind in ("translation", "scale") for axis in "xyz")
    assert [name for name in handles.names if not name.startswith("top.")] == []
    near(handles.coordinates(handles.offsets(handles.z0)), handles.z0)
    assert handles.project(randn(1, 30, 3)).isfinite().all()


@pytest.mark.parametrize("family", FAMILIES)
def test_generated_shapes_are_B_z0(family):
    shapes = shapes_of(family, 2, 300, dtype="float64")
    handles = BoxHandles(shapes.labels[1], shapes.rest[1], shapes.boxes[1], shapes.part_names)
    near(handles.offsets(handles.z0), shapes.points[1])
    assert handles.names[:2] == tuple(f"{shapes.part_names[0]}.translation.{axis}" for axis in "xy")


@pytest.mark.parametrize(
    ("labels", "rest", "boxes", "names", "said"),
    [
        ((3,), (4, 3), (1, 15), None, r"labels must be \(n,\), .* and rest \(n, 3\), got \(3,\) and \(4, 3\); take"),
        ((4,), (4, 3), (1, 14), None, r"boxes must be \(P, 15\), got \(1, 14\); take one shape's"),
        ((4,), (4, 3), (0, 15), None, r"labels must be below the 0 parts, got 0; take one shape's"),
        ((4,), (4, 3), (2, 15), ("leg",), r"part_names must be one for each of the 2 boxes, all different, got leg;"),
        ((4,), (4, 3), (2, 15), ("leg", "leg"), r"part_names must .*, got leg, leg; number those that repeat"),
    ],
)
def test_it_refuses_what_does_not_belong_together(labels, rest, boxes, names, said):
    sizes = torch.zeros(labels).long(), torch.zeros(rest), torch.zeros(boxes)
    with pytest.raises(ValueError, match=f"BoxHandles: {said}"):
        unchecked(BoxHandles.__init__)(object.__new__(BoxHandles), *sizes, names)


def test_edges_stay_above_nothing_whatever_parts_are_called():
    labels, boxes = torch.arange(60) % 2, torch.cat([torch.zeros(3), torch.eye(3).flatten(), 2 * torch.ones(3)])
    handles = BoxHandles(labels, randn(0, 60, 3), boxes.double().expand(2, 15), ("a.scale.b", "top"))
    bounded = [name for name, low in zip(handles.names, handles.lower.tolist(), strict=True) if low > -torch.inf]
    assert bounded == [f"{part}.scale.{axis}" for part in ("a.scale.b", "top") for axis in "xyz"]
    assert ((0 < handles.lower) & (handles.lower < 0.01) | (handles.lower == -torch.inf)).all()
    assert (handles.upper == torch.inf).all()


def test_at_other_points_the_same_values_place_them():
    points, handles = boxed(0, n=60)
    order = torch.randperm(60, generator=torch.Generator().manual_seed(0))[:25]
    there = handles.at(handles.labels[order], handles.rest[order])
    assert there.names == handles.names
    near(there.offsets(there.z0), points[order])
    near(torch.einsum("ncm,m->nc", there.B, there.z0), points[order])
    near(handles.offsets(handles.z0), points)


def test_at_points_of_no_part_nothing_moves():
    _, handles = boxed(0)
    there = handles.at(torch.tensor([-1, 2]), torch.full((2, 3), float("nan")).double())
    moved = there.offsets(handles.z0)
    assert there.held.tolist() == [False, True]
    assert (moved[0] == 0).all()
    near(moved[1], there.rotation[2] @ handles.z0.view(3, 2, 3)[2, 0])


@pytest.mark.parametrize("labels", [[0, 3], [-2, 0]])
def test_at_refuses_parts_that_are_not_there(labels):
    _, handles = boxed(0)
    with pytest.raises(ValueError, match=r"BoxHandles: labels must be .*; take one shape's"):
        handles.at(torch.tensor(labels), torch.zeros(2, 3).double())


@pytest.mark.parametrize("sampling", ["shared", "fresh"])
def test_of_takes_one_shape_of_a_collection(sampling):
    shapes = shapes_of("table/shelf", 3, 300, sampling=sampling, dtype="float64")
    handles = BoxHandles.of(shapes, 2)
    near(handles.offsets(handles.z0), shapes.points[2])
    assert handles.names[0].split(".")[0] == shapes.part_names[0]


def test_of_a_mixed_collection_lacks_what_a_family_lacks():
    shapes = shapes_of("chair", 12, 256, dtype="float64")
    assert len({len(BoxHandles.of(shapes, i).names) for i in range(12)}) > 1
    for i in range(12):
        handles = BoxHandles.of(shapes, i)
        held = {shapes.part_names[j] for j in shapes.labels[i].unique().tolist()}
        assert {name.rsplit(".", 2)[0] for name in handles.names} == held
        near(handles.offsets(handles.z0), shapes.points[i])


def test_of_points_without_parts_is_refused():
    with pytest.raises(ValueError, match=r"BoxHandles: shapes must have labels, .* no parts; take shapes of data_gen"):
        BoxHandles.of(Shapes(points=torch.zeros(1, 4, 3)))


def test_a_part_of_no_thickness_has_no_edge_there_but_a_place():
    P, n = 2, 80
    rest, labels = randn(0, n, 3) / 4, torch.arange(n) % P
    boxes = torch.cat([randn(1, P, 3), rotations(2, P).flatten(1), torch.tensor([[0.5, 0.0, 0.3], [0, 0, 0.2]])], 1)
    rest = torch.where(boxes[labels, 12:] == 0, 0.0, rest)
    handles = BoxHandles(labels, rest, boxes)
    assert handles.dropped == ("part_0.scale.y", "part_1.scale.x", "part_1.scale.y")
    R = boxes[labels, 3:12].unflatten(-1, (3, 3))
    near(handles.offsets(handles.z0), boxes[labels, :3] + (R @ (boxes[labels, 12:] * rest)[..., None])[..., 0])
    u, B = randn(3, n, 3), matrix(handles.B)
    near(handles.project(u), (B @ (torch.linalg.pinv(B) @ u.flatten())).view(n, 3))


def test_64_parts():
    points, handles = boxed(0, P=64, n=64 * 9)
    assert len(handles.names) == 64 * 6
    near(handles.coordinates(points), handles.z0)
    u, B = randn(1, 64 * 9, 3), matrix(handles.B)
    near(handles.project(u), (B @ (torch.linalg.pinv(B) @ u.flatten())).view(u.shape))


def test_box_handles_are_the_dense_handles_of_their_matrix():
    _, handles = boxed(0, flat=2)
    dense = DenseHandles(handles.B, handles.z0, handles.names, lower=handles.lower, upper=handles.upper)
    u = randn(0, 40, 3)
    near(dense.project(u), handles.project(u))
    near(dense.coordinates(u), handles.coordinates(u))
    near(dense.offsets(dense.z0), handles.offsets(handles.z0))
