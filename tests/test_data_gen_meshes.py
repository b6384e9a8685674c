"""Meshes of shapes, written and read again."""

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

import data_gen
from data_gen.colours import PALETTE, colours, kind


@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
@pytest.mark.parametrize("name", ["table/shelf", "carton/two_flaps"])
def test_written_meshes_keep_their_form_and_colours(tmp_path, name, ending):
    rig = data_gen.family(name)
    scene = data_gen.mesh(rig.name, rig.middle[0])
    data_gen.save_mesh(scene, tmp_path / f"one.{ending}")
    data_gen.save_mesh(data_gen.mesh("box/one", [0.5, 0.5, 0.5]), tmp_path / f"two.{ending}")
    read = trimesh.load_scene(tmp_path / f"one.{ending}").to_mesh()
    assert np.isclose(read.volume, scene.to_mesh().volume, rtol=1e-5)
    again = trimesh.load_scene(tmp_path / f"one.{ending}")
    assert _colours(again) == _colours(scene)
    assert not list(tmp_path.glob("*.part"))


def _colours(scene):
    """Every colour in use, with the low corner of the box around all its points."""
    found = {}
    for part in scene.dump():
        if part.visual.kind == "texture":
            used = np.tile(part.visual.material.main_color, (len(part.vertices), 1))
        else:
            used = np.asarray(part.visual.vertex_colors)
        for colour in np.unique(used, axis=0):
            lowest = part.vertices[(used == colour).all(axis=1)].min(axis=0).round(4)
            key = tuple(colour.tolist())
            found[key] = tuple(np.minimum(lowest, found.get(key, np.inf)).tolist())
    return found


def test_a_mesh_is_posed():
    rig = data_gen.family("carton/two_flaps")
    for row in (rig.low, rig.high):
        scene = data_gen.mesh(rig.name, row)
        np.testing.assert_allclose(
            scene.to_mesh().bounds, [f(rig.vertices(row[None])[0], axis=0) for f in (np.min, np.max)]
        )


def test_an_unknown_mesh_format_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"save_mesh: a mesh file must end in .glb, .obj, .ply, got a.stl; choose"):
        data_gen.save_mesh(data_gen.mesh("box/one", [0.5, 0.5, 0.5]), tmp_path / "a.stl")


def test_a_mesh_out_of_range_is_refused():
    with pytest.raises(ValueError, match=r"mesh: depth of box/one must be in \[0.3, 1\], got 2 in row 0"):
        data_gen.mesh("box/one", [0.5, 0.5, 2])


def test_parts_of_one_kind_have_one_hue_and_others_another():
    told = dict(zip(data_gen.family("table/shelf").part_names, colours("table/shelf").tolist(), strict=True))
    assert told["leg_1"] == told["leg_3"] != told["leg_2"] == told["leg_4"]
    assert told["top"] == list(bytes.fromhex(PALETTE[0][1:]))
    assert len({tuple(told[name]) for name in ("top", "leg_1", "leg_2", "shelf")}) == 4
    assert dict(
        zip(data_gen.family("table/four_legs").part_names, colours("table/four_legs").tolist(), strict=True)
    ) == {name: colour for name, colour in told.items() if name != "shelf"}


@pytest.mark.parametrize("name", data_gen.families())
def test_kinds_have_different_hues_as_long_as_there_are_any(name):
    names = data_gen.family(name).part_names
    first = {
        kind(part): tuple(colour) for part, colour in reversed(list(zip(names, colours(name).tolist(), strict=True)))
    }
    assert len(set(first.values())) == min(len(first), len(PALETTE))


@pytest.mark.parametrize(
    ("part", "expected"),
    [("leg_1", "leg"), ("wing_left", "wing"), ("wheel_front_left", "wheel"), ("flap_12", "flap"), ("top", "top")],
)
def test_a_kind_is_the_name_without_what_tells_parts_apart(part, expected):
    assert kind(part) == expected


@pytest.mark.parametrize("ending", ["glb", "obj"])
@pytest.mark.parametrize("name", ["table/shelf", "carton/two_flaps", "desk_lamp/bracket"])
def test_written_meshes_keep_their_uvs(tmp_path, name, ending):
    rig = data_gen.family(name)
    data_gen.save_mesh(data_gen.mesh(name, rig.middle[0]), tmp_path / f"one.{ending}")
    read = trimesh.load_scene(tmp_path / f"one.{ending}", process=False).dump()
    corners = np.concatenate([np.hstack([part.vertices, part.visual.uv])[part.faces].reshape(-1, 5) for part in read])
    wanted = np.hstack([rig.vertices(rig.middle)[0], rig.uv])[rig.triangles].reshape(-1, 5)
    assert len(corners) == len(wanted)
    far, _ = cKDTree(corners).query(wanted)
    assert far.max() < 1e-5
    assert np.ptp(rig.uv, axis=0).min() > 0.5


@pytest.mark.parametrize(
    ("given", "said"),
    [({"width": 0.5}, "{'width': 0.5}"), (["a", 1, 2], r"\['a', 1, 2\]"), ([[1], [1, 2]], r"\[\[1\], \[1, 2\]\]")],
)
def test_a_mesh_of_what_are_no_numbers_is_refused(given, said):
    words = rf"mesh: parameters must be numbers for width, height, depth, got {said}; give a list in this order"
    with pytest.raises(ValueError, match=words):
        data_gen.mesh("box/one", given)
