"""modes: numbers that read a dictionary, each against a slow twin, a truth that is known, and a case it must refuse."""

from dataclasses import replace
from itertools import permutations

import pytest
import torch
from worlds import deform_sync_net, near, randn, shapes_of, unchecked

import data_gen
from dsn_lite import DoNothing, LinearSpace, modes
from dsn_lite.data import triplets
from dsn_lite.files import as_shapes
from dsn_lite.handles import BoxHandles
from dsn_lite.space import ActionSpace


class Known(ActionSpace):
    """A dictionary that is known for a few shapes, looked up by their points."""

    def __init__(self, points, A):
        super().__init__()
        self.register_buffer("points", points)
        self.register_buffer("A", A)

    def dictionary(self, x):
        return self.A[(self.points.unsqueeze(0) == x.unsqueeze(1)).flatten(2).all(-1).double().argmax(1)]

    def act(self, x, v):
        return x + torch.einsum("...nck,...k->...nc", self.dictionary(x), v)

    def vector(self, x, y):
        return x.new_zeros(len(x), self.A.shape[-1])


class Field(ActionSpace):
    """A dictionary that is a function of a shape and of the places where it is asked for."""

    def __init__(self, fields):
        super().__init__()
        self.fields = fields

    def dictionary(self, x, at=None):
        return self.fields(x, x if at is None else at)

    def act(self, x, v):
        return x

    def vector(self, x, y):
        return x.new_zeros(len(x), 3)


def truth(family, count=20, points=256, seed=3):
    """Shapes and the space of their parameters."""
    drawn = data_gen.generate(family, count=count, points=points, seed=seed, dtype="float64")
    shapes = as_shapes(drawn)
    return Known(shapes.points, torch.from_numpy(data_gen.valid_space(drawn))), shapes


@pytest.fixture(scope="module")
def chairs():
    """Mixed chairs, more than are read at once, some of whose points are of no part."""
    shapes = shapes_of("chair", count=20, points=80, seed=3, dtype="float64")
    labels = shapes.labels.expand(shapes.points.shape[:2]).clone()
    labels[:, ::16] = -1
    return replace(shapes, labels=labels)


@pytest.fixture(scope="module")
def network():
    return deform_sync_net(2).eval().requires_grad_(False)


@pytest.fixture(scope="module")
def reading(network, chairs):
    return modes.read(network, chairs)


def test_moved_by_columns_is_the_rms_of_what_each_column_alone_does():
    A, v = randn(0, 4, 9, 3, 5), randn(1, 4, 5)
    alone = torch.stack([A[..., j] * v[:, j, None, None] for j in range(5)])
    near(modes.moved_by_columns(A, v), alone.square().sum(-1).mean((1, 2)).sqrt())
    near(modes.moved_by_columns(A[0], v), modes.moved_by_columns(A[:1].expand(4, 9, 3, 5), v))  # one A, many vectors
    near(modes.moved_by_columns(A[0], v[0]), modes.moved_by_columns(A[:1], v[:1]))
    near(modes.moved_by_lengths(A.square().sum(2).mean(1).sqrt(), v), modes.moved_by_columns(A, v))


def test_dead_columns_are_those_that_no_vector_uses_or_that_move_nothing():
    A, v = randn(0, 4, 9, 3, 5), randn(1, 4, 5)
    assert modes.dead_columns(A, v).tolist() == []
    v[:, 1], A[..., 3] = 1e-4, 0
    assert modes.dead_columns(A, v).tolist() == [1, 3]
    assert modes.dead_columns(A, v, below=0.0).tolist() == [3]
    assert modes.dead_columns(A, torch.zeros_like(v)).tolist() == [0, 1, 2, 3, 4]  # a space that has collapsed


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("leg_1", "leg"),
        ("leg_left", "leg"),
        ("rail_front_left_2", "rail"),
        ("back", "back"),
        ("seat_back", "seat"),
        ("fore_leg", "fore_leg"),
    ],
)
def test_kind_is_the_name_without_what_tells_parts_apart(name, kind):
    assert modes.kind(name) == kind == data_gen.colours.kind(name)
    assert modes.kinds(["seat", "leg_1", "leg_2", "seat"]) == ("seat", "leg")


def test_reading_is_what_loops_over_shapes_and_parts_find(network, chairs, reading):
    for i in range(len(chairs)):
        A, labels, x = network.dictionary(chairs.points[i]), chairs.labels[i], chairs.points[i]
        boxes = chairs.boxes[i].nan_to_num()
        handles, rest = BoxHandles(labels, chairs.rest[i].nan_to_num(), boxes), A.square().sum(1)
        assert torch.equal(reading.real[i], handles.kept.flatten())
        near(reading.handles[i][reading.real[i]], handles.coordinates(A))
        near(reading.inside[i], handles.project(A).square().sum((0, 1)) / rest.sum(0))
        for p in range(len(chairs.part_names)):
            near(reading.energy[i, p], rest[labels == p].sum(0) / rest.sum(0))
        near(reading.still[i], (rest.sqrt() < 0.1 * rest.sqrt().amax(0)).double().mean(0))
        for q, kind in enumerate(reading.kinds):
            own = torch.tensor([label >= 0 and modes.kind(chairs.part_names[label]) == kind for label in labels])
            assert reading.present[i, q] == own.any()
            near(reading.profile[i, q], profile(x[own], A[own]) * own.double().mean().sqrt() / rest.mean(0).sqrt())


def profile(x, A):
    """Mean, and slope times spread, of each coordinate of each column: least squares, one number at a time."""
    found = torch.zeros(6, A.shape[-1], dtype=A.dtype)
    for c in range(3 if len(x) else 0):
        known = torch.stack([torch.ones_like(x[:, c]), x[:, c] - x[:, c].mean()], 1)
        spread = known[:, 1].square().mean().sqrt()
        slope = torch.linalg.lstsq(known, A[:, c]).solution[1] if spread > 1e-9 else 0
        found[c], found[3 + c] = A[:, c].mean(0), slope * spread
    return found


def test_shares_stay_below_the_whole(reading):
    near(reading.rms, torch.ones_like(reading.rms))
    assert (reading.energy.sum(1) < 0.99).all()  # the rest is in points of no part
    near(reading.energy_by_kind.sum(1), reading.energy.sum(1))
    assert (reading.profile.square().sum(2) <= reading.energy_by_kind + 1e-9).all()
    assert (reading.inside <= 1 + 1e-9).all()


def test_only_some_modes_are_kept(reading):
    few = reading.only([2, 0])
    assert torch.equal(few.handles[..., 1], reading.handles[..., 0])
    near(few.energy_by_kind, reading.energy_by_kind[..., [2, 0]])


def test_parts_moved_counts_parts():
    _, shapes = truth("table/four_legs", count=4)
    labels = shapes.labels.expand(4, -1)
    alone = torch.stack([(labels == 0).double(), (labels >= 0) / labels.shape[1] ** 0.5, 0.0 * labels], -1)
    reading = modes.read(Known(shapes.points, alone.unsqueeze(2).expand(-1, -1, 3, -1)), shapes)
    shares = torch.stack([(labels == part).double().mean(1) for part in range(5)])
    near(reading.parts_moved[:, 0], torch.ones(4, dtype=torch.float64))
    near(reading.parts_moved[:, 1], 1 / shares.square().sum(0))
    assert not reading.parts_moved[:, 2].any()  # a column of zeros moves none
    near(reading.still[:, 0], 1 - shares[0])


@pytest.mark.parametrize("below", [0.01, 0.2])
def test_quiet_share_is_counted_a_shape_at_a_time_over_real_handles(reading, below):
    shares = []
    for H, real in zip(reading.handles, reading.real, strict=True):
        size = [abs(value) for row, known in zip(H.tolist(), real.tolist(), strict=True) if known for value in row]
        shares.append(sum(value < below * max(size) for value in size) / len(size))
    assert modes.quiet_share(reading, below) == pytest.approx(sum(shares) / len(shares))
    assert modes.nonzero_elements(reading, [below]) == {below: pytest.approx(1 - sum(shares) / len(shares))}


def test_nonzero_columns_are_counted_against_the_longest(reading):
    six = reading.only([0, 1, 2, 0, 1, 2])
    six = replace(six, handles=six.handles * torch.tensor([1, 1, 1, 0.1, 0.1, 0.0]))
    longest = reading.handles.norm(dim=1)
    share = longest / longest.amax(1, keepdim=True)
    expected = {0.0: 6, 1e-6: 5, 0.5: (share >= 0.5).sum().item() / len(longest), 1.0: 1}
    assert modes.nonzero_columns(six, list(expected)) == pytest.approx(expected)


def test_true_modes_are_quieter_than_the_same_space_in_another_basis():
    space, shapes = truth("table/four_legs")
    turned = modes.change_of_basis(space, torch.linalg.qr(randn(0, 6, 6)).Q)
    assert modes.quiet_share(modes.read(space, shapes)) > 0.7
    assert modes.quiet_share(modes.read(turned, shapes)) < 0.2


def test_consistency_is_the_cosine_over_pairs_and_kinds_that_both_have(reading):
    p, N, k = reading.profile, len(reading.profile), reading.profile.shape[-1]
    agreed, total = torch.zeros(2, k, k, dtype=p.dtype)
    for x, y in permutations(range(N), 2):
        both = reading.present[x] & reading.present[y]
        a, b = p[x][both].flatten(0, 1), p[y][both].flatten(0, 1)
        agreed, total = agreed + a.mT @ b, total + a.norm(dim=0)[:, None] * b.norm(dim=0)
    near(modes.consistency(reading), agreed.diagonal() / total.diagonal())
    differ = ~torch.eye(k, dtype=bool)
    assert modes.shuffled(reading) == pytest.approx((agreed[differ].sum() / total[differ].sum()).item())


def test_true_modes_are_consistent_and_inconsistent_ones_are_not():
    space, shapes = truth("table/four_legs", points=1024)
    reading = modes.read(space, shapes)
    assert modes.consistency(reading).min() > 0.97
    assert abs(modes.shuffled(reading)) < 0.3
    sign = torch.ones(20, 1, 1, 1, dtype=torch.float64)
    sign[::2] = -1  # a mode that raises one table lowers the next
    lost = modes.consistency(modes.read(Known(shapes.points, space.A * sign), shapes))
    assert lost.max() < 0


def test_consistency_of_a_column_that_moves_nothing_is_zero():
    space, shapes = truth("table/four_legs", count=4)
    space.A[..., 2] = 0
    assert modes.consistency(modes.read(space, shapes))[2] == 0


def place(x, at):
    """The same field of places for every shape."""
    return torch.stack([at, at.flip(-1) ** 2, 1 + at], -1).double()


def part(x, at):
    """A field that follows the one part of a shape that is a box."""
    low, high = x.amin(-2, keepdim=True), x.amax(-2, keepdim=True)
    return place(x, (at - low) / (high - low))


def test_following_tells_parts_from_places():
    shapes = shapes_of("box/one", count=16, points=600)
    x, y = shapes[:8], shapes[8:]
    by_part, by_place = modes.following(Field(part), x, y)
    assert by_part.min() > 0.9999
    assert by_place.min() < 0.99
    by_part, by_place = modes.following(Field(place), x, y)
    near(by_place, torch.ones(3, dtype=torch.float64))
    assert by_part.min() < 0.99


def test_following_leaves_out_points_whose_part_the_other_lacks(network, chairs):
    x, y = chairs[:10], chairs[10:]
    there = y.boxes.isfinite().all(-1)
    dot, squares = 0, 0
    for i in range(10):
        known = torch.tensor([label >= 0 and bool(there[i, label]) for label in x.labels[i]])
        a = network.dictionary(x.points[i])[known]
        b = network.dictionary(y.points[i], at=x.at_boxes(y.boxes)[i][known])
        dot, squares = dot + (a * b).sum((0, 1)), squares + torch.stack([a, b]).square().sum((1, 2))
    near(modes.following(network, x, y).by_part, dot / squares.prod(0).sqrt())


def test_a_change_of_basis_changes_modes_and_no_deformation(network, chairs):
    x, y, z = (one.points for one in triplets(chairs, 6))
    R = randn(5, 3, 3)
    other = modes.change_of_basis(network, R)
    near(other.deform(x, y), network.deform(x, y))
    near(other.transfer(x, y, z), network.transfer(x, y, z))
    near(other.dictionary(x), network.dictionary(x) @ R)
    near(other.dictionary(x, at=y), network.dictionary(x, at=y) @ R)
    near(other.vector(x, y) @ R.mT, network.vector(x, y))
    near(other.untrained(1).deform(x, y), network.untrained(1).deform(x, y))
    assert other.by_construction == network.by_construction
    assert modes.quiet_share(modes.read(other, chairs)) != modes.quiet_share(modes.read(network, chairs))


@pytest.mark.parametrize(
    ("R", "said"),
    [
        (torch.ones(3, 3), r"\(3, 3\) of rank 1"),
        (torch.eye(3)[:2], r"\(2, 3\)"),
        (torch.eye(2), r"\(2, 2\)"),
        (torch.full((3, 3), torch.nan), r"\(3, 3\)"),
    ],
)
def test_change_of_basis_refuses_what_has_no_inverse(network, R, said):
    with pytest.raises(
        ValueError, match=rf"change_of_basis: R must be \(k, k\), k = \d, finite and invertible, got {said}; otherwise"
    ):
        unchecked(modes.change_of_basis)(network, R)


def test_a_space_without_a_dictionary_is_refused(chairs):
    said = r"the space must have a dictionary, DoNothing has none; use a DeformSyncNet"
    with pytest.raises(ValueError, match=f"modes.read: {said}"):
        modes.read(DoNothing(), chairs)
    with pytest.raises(ValueError, match=f"change_of_basis: {said}"):
        modes.change_of_basis(DoNothing(), torch.eye(1))
    with pytest.raises(ValueError, match=f"local_basis: {said}"):
        modes.local_basis(DoNothing(), chairs, chairs.points)
    with pytest.raises(ValueError, match=f"following: {said}"):
        modes.following(DoNothing(), chairs, chairs)


def test_shapes_without_parts_are_refused(network, chairs):
    bare = replace(chairs, boxes=None, part_names=())
    with pytest.raises(ValueError, match=r"modes.read: shapes must have boxes and names of their parts, these"):
        modes.read(network, bare)
    with pytest.raises(ValueError, match=r"following: shapes must have labels, rest and boxes, these have no parts"):
        modes.following(network, chairs, bare)


def test_varimax_finds_sparse_columns_back(reading):
    N, m = reading.real.shape
    sparse = torch.where(randn(1, N, m, 5) > 1, randn(0, N, m, 5), 0) * torch.linspace(1, 2, 5)
    turn = torch.linalg.qr(randn(2, 5, 5)).Q
    H = sparse @ turn.mT * torch.where(reading.real, 1.0, 100.0).unsqueeze(-1)  # padding must not count
    R = modes.varimax(replace(reading.only([0] * 5), handles=H))
    near(R @ R.mT, torch.eye(5, dtype=torch.float64))
    found = (turn.mT @ R).abs()  # a permutation, but for signs, where the columns are found back
    assert found.amax(0).min() > 0.99
    assert found.argmax(0).tolist() == [4, 3, 2, 1, 0]  # the strongest first


@pytest.fixture(scope="module")
def scrambled():
    """Tables, and their true linear space with two columns too many, in a random basis."""
    drawn = data_gen.generate("table/four_legs", count=40, points=300, seed=3, sampling="shared", dtype="float64")
    shapes, A = as_shapes(drawn), torch.from_numpy(data_gen.valid_space(drawn)[0])
    extra = torch.cat([A, 0.1 * randn(0, 300, 3, 2)], -1)
    return LinearSpace(extra @ randn(1, 8, 8)), shapes, A


def test_principal_directions_are_the_freedoms_of_the_shapes(scrambled):
    space, shapes, _ = scrambled
    x, y = shapes.points, shapes.points.roll(1, 0)
    W, share = modes.principal(space, x, y)
    assert int((share > 1e-9).sum()) == 6
    assert share.sum() == pytest.approx(1)
    coordinates = torch.linalg.lstsq(W[:, :6], space.vector(x, y).mT).solution
    near(coordinates @ coordinates.mT / 40, torch.eye(6, dtype=torch.float64))
    columns = (space.dictionary(x) @ W).flatten(0, 2)
    near((columns.mT @ columns / columns.mT.square().sum()), torch.diag(share))


def test_disagreement_is_how_far_two_dictionaries_along_a_deformation_differ_written_out():
    space, x, y = deform_sync_net(), randn(0, 3, 9, 3), randn(1, 3, 9, 3)
    W, squares = randn(2, space.dictionary(x).shape[-1], 2), []
    for here, there in zip(x, y, strict=True):
        change = (space.dictionary(space.deform(here, there)) - space.dictionary(here)) @ W
        squares += [change[:, :, j].square().sum(-1).mean() / 2 for j in range(2)]
    assert modes.disagreement(space, x, y, W) == pytest.approx((sum(squares) / len(squares)).sqrt().item())


def test_one_dictionary_for_all_shapes_never_disagrees():
    x = randn(0, 8, 9, 3)
    assert modes.disagreement(LinearSpace.fit(x, 3), x, x.roll(1, 0), randn(2, 3, 2)) == 0


def test_local_basis_finds_the_parameters_of_tables(scrambled):
    space, shapes, A = scrambled
    x, y = shapes, shapes.points.roll(1, 0)
    local = modes.local_basis(space, x, y)
    assert local.used == 6
    other = modes.change_of_basis(space, local.R)
    near(other.deform(x.points, y), space.deform(x.points, y))
    moved = modes.moved_by_columns(other.dictionary(x.points), other.vector(x.points, y))
    assert (moved[:6] > 1e6 * moved[6:].max()).all()
    near(modes.read(other, x).rms.square().mean(0), torch.ones(8, dtype=torch.float64))
    found, true = other.dictionary(x.points)[0].flatten(0, 1)[:, :6], A.flatten(0, 1)
    alike = (found / found.norm(dim=0)).mT @ (true / true.norm(dim=0))
    thickness, *others = sorted(range(6), key=lambda i: shapes.parameter_names[i] != "top_thickness")
    assert alike.abs().amax(0)[others].min() > 0.98  # each is one of the modes
    # a thicker top at the same height shortens all legs; on the same legs it is the top alone that moves, more locally
    (left,) = set(range(6)) - set(alike.abs().argmax(0)[others].tolist())
    assert alike[left, thickness].abs() < 0.2
    assert modes.read(other, x).energy[:, shapes.part_names.index("top"), left].min() > 0.95


@pytest.fixture(scope="module")
def shelves():
    """The true dictionary of tables with and without a shelf; the last but one of its columns moves the shelf alone."""
    space, shapes = truth(("table/four_legs", "table/shelf"), count=24)
    return space, shapes, shapes.parameter_names.index("shelf_height")


def test_silence_of_the_true_shelf(shelves):
    space, shapes, column = shelves
    found = modes.silence(modes.read(space, shapes), "shelf")
    has = shapes.boxes[:, shapes.part_names.index("shelf")].isfinite().all(-1)
    assert (found.kind, found.mode, found.having, found.lacking) == ("shelf", column, has.sum(), (~has).sum())
    assert (found.share, found.rms, found.handles) == (1, 0, 0)


def test_normalised_columns_are_not_silent(shelves):
    _, shapes, _ = shelves
    noisy = randn(0, *shapes.points.shape, 3)
    noisy[..., 1] = torch.where(shapes.labels.unsqueeze(-1) == shapes.part_names.index("shelf"), 5 * noisy[..., 1], 0)
    noisy[..., 1] += 0.01 * noisy[..., 0]
    A = noisy / noisy.square().sum(2).mean(1).sqrt()[:, None, None]
    reading = modes.read(Known(shapes.points, A), shapes)
    found = modes.silence(reading, "shelf")
    has = reading.present[:, reading.kinds.index("shelf")]
    lengths = reading.handles[..., 1].norm(dim=1)
    assert (found.mode, found.rms) == (1, pytest.approx(1))
    assert found.handles == pytest.approx((lengths[~has].mean() / lengths[has].mean()).item())


def test_silence_needs_shapes_with_and_without_the_part(shelves):
    space, shapes, _ = shelves
    reading = modes.read(space, shapes)
    with pytest.raises(ValueError, match=r"silence: kind must be one of top, leg, shelf, got 'leg_1'; leg_1 is a leg"):
        modes.silence(reading, "leg_1")
    with pytest.raises(ValueError, match=r"silence: some shapes must have a leg and others not, got 24 of 24 that do"):
        modes.silence(reading, "leg")


def test_echo_is_how_far_a_vector_moves_other_shapes():
    A = randn(0, 7, 3, 3)
    x, y, z = randn(1, 3, 5, 7, 3)
    space = LinearSpace(A)
    assert modes.echo(space, x, y, z) == pytest.approx(1)  # a linear space knows no shape from another
    assert modes.echo(space, x, x, z) == 0


def test_echo_is_silent_where_the_true_parts_are_not(shelves):
    space, shapes, column = shelves
    has = shapes.boxes[:, shapes.part_names.index("shelf")].isfinite().all(-1)
    v = torch.zeros(space.A.shape[-1], dtype=torch.float64)
    v[column] = 1
    space.vector = lambda x, y: v.expand(len(x), -1)
    x, z = shapes.points[has], shapes.points[~has]
    assert modes.echo(space, x, x, z) == 0
    assert modes.echo(space, x, x, x.roll(1, 0)) == pytest.approx(1)
