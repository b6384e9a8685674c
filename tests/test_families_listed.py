"""Families by name: categories, and the refusal of unknown ones."""

import numpy as np
import pytest

import data_gen

ENOUGH = {"airplane": 8, "car": 8, "chair": 8, "lamp": 8, "sofa": 8, "table": 8, "bed": 4, "cabinet": 4, "bench": 4}
ARTICULATED = (
    "carton/two_flaps",
    "carton/four_flaps",
    "carton/eight_flaps",
    *("eyeglasses", "swing", "laptop", "folding_chair", "desk_lamp", "scissors", "cabinet_doors"),
)


def test_there_are_as_many_families_as_promised():
    assert len(data_gen.families()) >= 96
    assert len(data_gen.categories()) >= 14
    for category, least in ENOUGH.items():
        assert len(data_gen.families(category)) >= least, category


@pytest.mark.parametrize("name", ARTICULATED)
def test_what_turns_in_life_turns_here(name):
    for family in [name] if "/" in name else data_gen.families(name):
        assert any(joint.kind == "hinge" for joint in data_gen.family(family).joint_list)


def test_somewhere_a_part_hangs_on_a_moving_part_and_somewhere_drawers_slide():
    joints = [data_gen.family(name).joint_list for name in data_gen.families()]
    assert any({one.on for one in own} & {part for one in own for part in one.parts} for own in joints)
    assert any(one.kind == "slide" for own in joints for one in own)


def test_families_of_a_category_differ_in_structure():
    for category in data_gen.categories():
        rigs = [data_gen.family(name) for name in data_gen.families(category)]
        told = {(rig.part_names, rig.parameter_names, len(rig.triangles)) for rig in rigs}
        assert len(told) == len(rigs)


def test_families_of_a_category_share_names_of_parts_and_parameters():
    for category in data_gen.categories():
        rigs = [data_gen.family(name) for name in data_gen.families(category)]
        for kind in ("part_names", "parameter_names"):
            known = [set(getattr(rig, kind)) for rig in rigs]
            assert all(any(own & other for other in known if other is not own) for own in known) or len(rigs) == 1


def test_the_papers_table_has_a_top_and_four_legs_at_its_corners():
    rig = data_gen.family("table/four_legs")
    top, *legs = rig.boxes(rig.middle)[0]
    signs = [(1, 1), (-1, 1), (1, -1), (-1, -1)]
    assert rig.part_names == ("top", "leg_1", "leg_2", "leg_3", "leg_4")
    for leg, sign in zip(legs, signs, strict=True):
        np.testing.assert_allclose(leg[[0, 2]] + sign * leg[[12, 14]] / 2, sign * top[[12, 14]] / 2, atol=1e-12)


def test_families_are_listed_by_category():
    assert data_gen.families("table")[:2] == ("table/four_legs", "table/shelf")
    assert set(data_gen.families("chair")) < set(data_gen.families())
    assert [data_gen.families(one)[0].split("/")[0] for one in data_gen.categories()] == list(data_gen.categories())


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match=r"families: a category must be one of table, .*, got 'spoon'; see families"):
        data_gen.families("spoon")
    with pytest.raises(ValueError, match=r"family: a family must be one of table/four_legs, .*, got 'table'; check"):
        data_gen.family("table")
    with pytest.raises(ValueError, match=r"family: a family must be one of .*, got 'spoon/one'; check the spelling"):
        data_gen.family("spoon/one")
