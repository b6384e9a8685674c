"""Parts of meshes: what is connected, what is merged, and what parts are called."""

import json
import struct

import numpy as np
import pytest
import trimesh
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

import data_gen
from dsn_lite import meshes
from dsn_lite.meshes.connecting import components
from dsn_lite.meshes.merging import merged
from dsn_lite.meshes.parts import unique_names


def box(size, place=(0, 0, 0)):
    return trimesh.creation.box(size).apply_translation(place)


def soup(mesh):
    """The same triangles without any shared vertex, as in an STL file."""
    return trimesh.Trimesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3), process=False)


def joined(*pieces):
    return trimesh.util.concatenate(list(pieces))


def stool(**more):
    """A seat of 12 triangles on four legs that touch it, then further pieces."""
    legs = [box((0.1, 1, 0.1), (x, -0.6, z)) for x in (-0.4, 0.4) for z in (-0.4, 0.4)]
    return joined(box((1, 0.2, 1)), *legs, *more.get("further", ()))


def by_walking(mesh):
    """The obvious twin: walk from face to face over edges between the same places that two faces share."""
    of_edge = {}
    for face, corners in enumerate(mesh.triangles.round(5).tolist()):
        for i in range(3):
            of_edge.setdefault(frozenset({tuple(corners[i]), tuple(corners[i - 1])}), []).append(face)
    found, label = [-1] * len(mesh.faces), 0
    for start in range(len(found)):
        waiting = [start] if found[start] < 0 else []
        label += bool(waiting)
        while waiting:
            face = waiting.pop()
            found[face] = label - 1
            waiting += [f for faces in of_edge.values() if face in faces for f in faces if found[f] < 0]
    return np.array(found)


PIPE = trimesh.creation.annulus(0.2, 0.3, 1, sections=8)


@pytest.mark.parametrize("mesh", [stool(), PIPE, joined(PIPE, box((1, 1, 1), (3, 0, 0)))])
@pytest.mark.parametrize("change", [lambda mesh: mesh, soup])
def test_components_are_found_by_walking_too(mesh, change):
    mesh = change(mesh)
    assert np.array_equal(components(mesh.vertices, mesh.faces), by_walking(mesh))


def test_what_touches_is_not_connected():
    flush = joined(box((1, 1, 1)), box((1, 1, 0.5), (1, 0, 0.75)), box((1, 1, 1), (-1, 1, 0)))  # face, corner and edge
    assert components(flush.vertices, flush.faces).max() == 2
    assert components(*(lambda s: (s.vertices, s.faces))(soup(flush))).max() == 2


def test_broken_meshes_have_components_too():
    cube = box((1, 1, 1))
    degenerate = np.vstack([cube.faces, [[0, 0, 1], [2, 2, 2], [0, 1, 0]]])
    assert components(cube.vertices, degenerate).max() == 0
    both_sides = soup(trimesh.Trimesh(cube.vertices, np.vstack([cube.faces, cube.faces[:, ::-1]]), process=False))
    assert components(both_sides.vertices, both_sides.faces).max() == 0
    open_box = soup(trimesh.Trimesh(cube.vertices, cube.faces[:-3], process=False))
    assert components(open_box.vertices, open_box.faces).max() == 0
    fin = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], [[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    assert components(fin.vertices, fin.faces).max() == 0  # three faces at one edge, which the file shares


@pytest.mark.parametrize("kind", ["ply", "stl", "obj"])
def test_parts_of_a_file_without_nodes(kind, tmp_path):
    meshes.save_mesh(stool(), tmp_path / f"stool.{kind}")
    parts = meshes.split(meshes.load_mesh(tmp_path / f"stool.{kind}"))
    assert np.array_equal(parts.faces, np.repeat(np.arange(5), 12))
    assert parts.names == tuple(f"part_{i}" for i in range(1, 6))
    assert len(parts) == 5


def test_vertices_and_faces_agree_and_stay():
    scene = trimesh.Scene()
    scene.add_geometry(soup(stool()), node_name="a")
    scene.add_geometry(stool(), node_name="b", transform=trimesh.transformations.translation_matrix([3, 0, 0]))
    parts = meshes.split(scene, by="components")
    assert len(parts) == 10
    pieces = list(meshes.surface.parts(scene).values())
    shift = np.cumsum([0, *(len(geometry.vertices) for geometry, _ in pieces)])
    faces = np.concatenate([geometry.faces + s for (geometry, _), s in zip(pieces, shift, strict=False)])
    assert (parts.vertices[faces] == parts.faces[:, None]).all()


def test_a_vertex_of_no_face_is_of_no_part():
    mesh = joined(box((1, 1, 1)), box((1, 1, 1), (2, 0, 0)))
    mesh = trimesh.Trimesh(np.vstack([mesh.vertices, [[9, 9, 9]]]), mesh.faces, process=False)
    assert meshes.split(mesh).vertices[-1] == -1


def test_a_screw_goes_to_the_closest_part():
    screws = [box((0.02, 0.02, 0.02), place) for place in ((0.47, -1, 0.4), (0, 0.2, 0))]
    parts = meshes.split(stool(further=screws))
    assert len(parts) == 5
    assert parts.faces[60:72].tolist() == [4] * 12  # the leg at (0.4, 0.4)
    assert parts.faces[72:].tolist() == [0] * 12  # the seat


def test_the_two_largest_stay_however_small():
    parts = meshes.split(joined(box((1, 1, 1)), box((0.01, 0.01, 0.01), (0.6, 0, 0))))
    assert np.bincount(parts.faces).tolist() == [12, 12]


def test_an_inner_shell_is_no_part_of_its_own_but_crossed_legs_are():
    shells = joined(box((1, 1, 1)), box((0.95, 0.95, 0.95)), box((1, 1, 1), (2, 0, 0)))
    assert meshes.split(shells).faces.tolist() == [0] * 24 + [1] * 12
    turns = [trimesh.transformations.rotation_matrix(angle, [0, 0, 1]) for angle in (0.7, -0.7)]
    crossed = joined(*(box((0.1, 2, 0.1)).apply_transform(turn) for turn in turns))
    assert len(meshes.split(crossed)) == 2  # their upright boxes are one and the same


def test_flat_pieces_in_one_plane_overlap_and_in_two_do_not():
    sheets = [box((1, 1, 0), (0, 0, z)) for z in (0, 1e-4, 0.5)]
    assert len(meshes.split(joined(*sheets))) == 2


def test_more_than_the_limit_are_merged_smallest_first_and_those_alike_together():
    shelves = [box((2, 0.1, 1), (0, y, 0)) for y in range(4)]
    knobs = [box((0.5, 0.3, 0.3), (0.5, y + 0.3, 0)) for y in range(4)]
    mesh = joined(*shelves, *knobs)
    assert len(meshes.split(mesh)) == 8
    assert meshes.split(mesh, most=7).faces.tolist() == np.tile(np.repeat(np.arange(4), 12), 2).tolist()
    assert 2 <= len(meshes.split(mesh, most=3)) <= 3


def test_any_number_of_pieces_becomes_few():
    rng = np.random.default_rng(0)
    corners = rng.random((3000, 3, 3)) * 0.01 + rng.random((3000, 1, 3))
    into = merged(corners, np.arange(3000), 16, small=0.1, overlap=0.5)
    assert 2 <= len(np.unique(into)) <= 16
    assert np.array_equal(into[into], into)


@pytest.mark.parametrize("family", ["table/four_legs", "chair/dining", "sofa/chaise", "airplane/biplane"])
def test_nodes_of_a_scene_are_its_parts(family, tmp_path):
    shape = data_gen.generate(family, count=1, points=16, seed=0)
    data_gen.save_mesh(data_gen.mesh(family, shape.parameters[0]), tmp_path / "shape.glb")
    mesh = meshes.load_mesh(tmp_path / "shape.glb")
    parts = meshes.split(mesh)
    assert sorted(parts.names) == sorted(shape.part_names)
    assert parts.names == tuple(meshes.surface.parts(mesh))
    assert len(meshes.split(mesh, by="components")) <= 16


def test_pieces_of_one_mesh_by_material_are_taken_apart(tmp_path):
    scene = trimesh.Scene()
    for name, piece in {"oak": stool(), "steel": box((1, 0.1, 0.1), (0, -0.5, 0))}.items():
        piece.visual = TextureVisuals(np.zeros((len(piece.vertices), 2)), PBRMaterial(name=name))
        piece.metadata["from_gltf_primitive"] = True
        scene.add_geometry(piece, node_name=f"stool_{name}_1a2b3c")
    assert meshes.split(scene).names == ("oak_1", "oak_2", "oak_3", "oak_4", "oak_5", "steel")
    assert meshes.split(scene, by="nodes").names == ("oak", "steel")


def test_of_several_scenes_the_one_that_the_file_shows_is_taken(tmp_path):
    scene = trimesh.Scene()
    for name, x in {"seat": 0, "leg": 2, "floor": 4}.items():
        scene.add_geometry(box((1, 1, 1), (x, 0, 0)), node_name=name, geom_name=name)
    data = scene.export(file_type="glb")
    length = struct.unpack("<I", data[12:16])[0]
    head = json.loads(data[20 : 20 + length])
    rows = {node["name"]: i for i, node in enumerate(head["nodes"])}
    head["scenes"] = [{"nodes": [rows["floor"]]}, {"nodes": [rows["seat"], rows["leg"]]}]
    head["scene"] = 1
    text = json.dumps(head).encode()
    text += b" " * (-len(text) % 4)
    total = len(data) + len(text) - length
    body = data[:8] + struct.pack("<II", total, len(text)) + data[16:20] + text + data[20 + length :]
    (tmp_path / "two.glb").write_bytes(body)
    assert sorted(meshes.split(meshes.load_mesh(tmp_path / "two.glb")).names) == ["leg", "seat"]


def test_names_can_be_told_in_a_handle():
    assert unique_names(["leg.front left", "leg*[1]", "Sitz", "mesh", "geometry_0"]) == (
        "leg_front_left",
        "leg_1",
        "Sitz",
        "part_1",
        "part_2",
    )
    assert unique_names(["leg", "leg", "leg_1"]) == ("leg_2", "leg_3", "leg_1")


@pytest.mark.parametrize(
    ("mesh", "options", "words"),
    [
        (
            box((1, 1, 1)),
            {},
            "split: a mesh must have 2 parts or more, this is one connected piece; separate",
        ),
        (stool(), {"by": "names"}, 'split: by must be "auto", "nodes" or "components", got \'names\''),
        (stool(), {"most": 1}, "split: most must be between 2 and 64 parts, got 1"),
        (stool(), {"most": 65}, "got 65"),
        (trimesh.Scene(), {}, "split: a mesh needs faces, got none"),
    ],
)
def test_what_cannot_be_split_is_refused(mesh, options, words):
    with pytest.raises(ValueError, match=words):
        meshes.split(mesh, **options)
