"""What a rig says about its shapes is true: points, joints, boxes, and its refusals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import data_gen
from data_gen import draw, fits
from data_gen.joint import hinge
from data_gen.part import box, loft, section
from data_gen.rig import Contact, Parameter, Rig

EXACT = 1e-12
SEEDS = st.integers(0, 2**32 - 1)


def drawn(name, seed, count=4, points=50):
    """A rig, random parameters of it, and shared samples."""
    rig = data_gen.family(name)
    streams = [np.random.default_rng(seed + i) for i in range(4)]
    return rig, rig.draw(count, np.random.default_rng(seed)), draw.fresh(rig, rig.middle, points, streams).row(0)


def wedge(p):
    """A block that tapers: its rest coordinates are not the same in all shapes."""
    return (loft("body", [section("y", (0, -0.5, 0), (p.low, 0.3)), section("y", (0, 0, 0), (p.high, 0.3))]),)


WEDGE = Rig("wedge/one", (Parameter("low", 0.1, 1.0, ""), Parameter("high", 0.1, 1.0, "")), wedge, (("body", "body"),))


@pytest.mark.parametrize("name", ["table/shelf", "carton/two_flaps"])
@given(seed=SEEDS)
def test_placing_own_samples_equals_a_slow_loop(name, seed):
    rig, parameters, _ = drawn(name, seed, count=3)
    samples = draw.fresh(rig, parameters, 20, [np.random.default_rng(seed + i) for i in range(4)])
    boxes, rest = rig.boxes(parameters), rig.sampled(samples, parameters)[1]
    slow = np.zeros((3, 20, 3))
    for shape in range(3):
        for point in range(20):
            own = boxes[shape, rig.triangle_part[samples.faces[shape, point]]]
            slow[shape, point] = own[:3] + own[3:12].reshape(3, 3) @ (own[12:] * rest[shape, point])
    np.testing.assert_allclose(rig.place(samples, parameters), slow, atol=EXACT)


def test_float32_points_are_those_of_float64_rounded():
    for name in ("table/shelf", "carton/two_flaps"):
        rig, parameters, samples = drawn(name, 3)
        exact, single = (rig.place(samples, parameters, dtype) for dtype in (np.float64, np.float32))
        assert single.dtype == np.float32
        np.testing.assert_allclose(single, exact, atol=1.8e-7)


def test_rest_coordinates_are_shared_where_parts_keep_their_form():
    rig, parameters, samples = drawn("table/shelf", 3)
    assert rig.sampled(samples, parameters)[1].shape == (50, 3)
    samples = draw.fresh(WEDGE, WEDGE.middle, 50, [np.random.default_rng(i) for i in range(4)]).row(0)
    parameters = np.array([[0.1, 1.0], [1.0, 0.1]])
    rest = WEDGE.sampled(samples, parameters)[1]
    assert rest.shape == (2, 50, 3)
    assert np.abs(rest[0] - rest[1]).max() > 0.3
    assert (WEDGE.fixed_rest, WEDGE.by_boxes, WEDGE.linear) == (False, False, True)


def test_boxes_tell_all_only_where_parts_neither_taper_nor_turn():
    table, carton = data_gen.family("table/four_legs"), data_gen.family("carton/two_flaps")
    assert (table.fixed_rest, table.by_boxes, table.linear) == (True, True, True)
    assert (carton.fixed_rest, carton.by_boxes, carton.linear) == (True, False, False)


def test_the_box_of_a_part_that_turns_turns_with_it():
    carton = data_gen.family("carton/two_flaps")
    upright, turned = (
        carton.boxes(np.array([[0.4, 0.3, 0.4, 0.15, 0.0, angle]]))[0, carton.part_names.index("flap_right")]
        for angle in (0.0, np.pi / 2)
    )
    np.testing.assert_allclose(turned[12:], upright[12:], atol=EXACT)
    np.testing.assert_allclose(turned[3:12].reshape(3, 3) @ [0, 1, 0], [1, 0, 0], atol=EXACT)


@pytest.mark.parametrize("value", [0.2999, 1.0001, np.nan])
def test_parameters_out_of_range_are_refused_by_name_and_range(value):
    rig, parameters, samples = drawn("box/one", 0)
    parameters[2, 1] = value
    with pytest.raises(ValueError, match=r"place: height of box/one must be in \[0.3, 1\], got .* in row 2; keep it"):
        rig.place(samples, parameters)
    with pytest.raises(ValueError, match=r"boxes: height of box/one must be in"):
        rig.boxes(parameters)


def test_ends_of_ranges_survive_float32():
    rig = data_gen.family("table/four_legs")
    ends = np.stack([rig.low, rig.high]).astype(np.float32)
    assert np.isfinite(rig.boxes(ends)).all()


def test_misshapen_parameters_are_refused():
    rig = data_gen.family("box/one")
    with pytest.raises(ValueError, match=r"boxes: box/one takes parameters \(N, 3\), width, height, depth, got \(3,\)"):
        rig.boxes(rig.middle[0])


def test_what_is_not_linear_is_found_out():
    bent = Rig("bent/one", WEDGE.parameters, lambda p: (box("body", (0, 0, 0), (p.low * p.high, 0.3, 0.3)),))
    assert fits.nonlinearity(WEDGE, WEDGE.draw(5, np.random.default_rng(0))) < EXACT
    assert fits.nonlinearity(bent, bent.draw(5, np.random.default_rng(0))) > 1e-2


def test_gaps_and_asymmetries_see_parts_that_do_not_fit():
    table = data_gen.family("table/four_legs")
    contacts = (Contact("leg_1", "top", "face_y"), Contact("leg_1", "top", "face_x"))
    wrong = Rig("wrong/one", table.parameters, table.build, (("leg_1", "leg_2"), ("leg_1", "leg_3")), contacts)
    (fit, overlaps), (mirrored, other) = fits.gaps(wrong, table.middle)[0], fits.asymmetries(wrong, table.middle)[0]
    assert abs(fit) < EXACT
    assert overlaps < -0.1
    assert mirrored < EXACT
    assert other > 0.1


def test_a_mirror_image_is_one_of_vertices_not_of_boxes_alone():
    def parts(p):
        slanted = [section("y", (0, -0.5, 0), (p.low, 0.2)), section("y", (0.2, 0, 0), (p.low, 0.2))]
        return loft("one", slanted), loft("same", slanted[::-1])

    leaning = Rig("leaning/one", WEDGE.parameters, parts, (("one", "same"),))
    assert fits.asymmetries(leaning, leaning.middle).max() > 0.05


def test_loose_hinges_see_a_pivot_in_the_air():
    def flap(p, height):
        hung = hinge("h", ["flap"], "body", (1, 0, 0), (0, height, 0), p.low)
        return box("body", (0, -0.25, 0), (1, 0.5, 1)), box("flap", (0, 0.1, 0), (1, 0.2, 0.1)), hung

    for height, apart in ((0.0, 0.0), (0.05, 0.05), (-0.1, 0.1)):
        rig = Rig("flap/one", WEDGE.parameters, lambda p, height=height: flap(p, height))
        np.testing.assert_allclose(fits.loose_hinges(rig, rig.middle), apart, atol=EXACT)


def test_parameters_are_uniform_in_their_ranges_and_exact_in_float32():
    rig = Rig("two/one", (Parameter("a", -1.0, 1.0, ""), Parameter("b", 0.1, 0.2, "")), lambda p: (), ())
    drawn = rig.draw(4000, np.random.default_rng(0))
    np.testing.assert_array_equal(drawn, drawn.astype(np.float32))
    quarters = np.floor((drawn - rig.low) / (rig.high - rig.low) * 4).astype(int)
    for column in quarters.T:
        assert np.abs(np.bincount(column, minlength=4)[:4] - 1000).max() < 5 * np.sqrt(1000)
    assert abs(np.corrcoef(drawn.T)[0, 1]) < 0.08
