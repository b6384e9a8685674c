"""Contact sheets: pictures, pages, and all of them in a folder."""

import re

import numpy as np
import pytest
from PIL import Image

import data_gen
from data_gen import catalogue, describe, gallery
from data_gen import sheet as sheets

RIG = data_gen.family("carton/two_flaps")


def test_a_sheet_shows_twelve_shapes_and_a_sweep_of_each_parameter():
    rows = -(-len(RIG.parameters) // sheets.SIDE_BY_SIDE)
    picture = np.asarray(sheets.sheet(RIG.name))
    assert picture.shape[1] == sheets.WIDTH
    assert picture.shape[0] > 3 * sheets.CELL * 0.3 + rows * sheets.LINE
    for column in np.array_split(picture[:, sheets.MARGIN : -sheets.MARGIN], sheets.COLUMNS, axis=1):
        assert (column < 200).any(axis=2).mean() > 0.05, "each column shows something"


def test_sweeps_go_from_one_end_of_each_range_to_the_other():
    swept = sheets.sweeps(RIG)
    for i in range(len(RIG.parameters)):
        others = np.delete(swept[i], i, axis=1)
        np.testing.assert_allclose(others, np.delete(RIG.middle, i, axis=1).repeat(sheets.STEPS, axis=0))
        assert (swept[i, 0, i], swept[i, -1, i]) == (RIG.low[i], RIG.high[i])
        first, *_, last = np.split(np.asarray(sheets.sweep(RIG, i)), sheets.STEPS, axis=1)
        assert (first != last).any(), RIG.parameter_names[i]


def test_another_seed_shows_other_shapes():
    assert (sheets.shapes(RIG, 0) != sheets.shapes(RIG, 1)).all()
    np.testing.assert_array_equal(sheets.shapes(RIG, 1), sheets.shapes(RIG, 1))


def test_angles_are_told_in_degrees_too():
    said = {one.name: sheets.range_of(one) for one in RIG.parameters}
    angle = next(one for one in RIG.parameters if one.unit == "rad")
    assert said[angle.name].endswith(f"{np.degrees(angle.high):.0f} degrees)")
    assert "degrees" not in said["width"]
    assert "2 hinges, articulated" in sheets.sort_of(RIG)
    assert sheets.sort_of(data_gen.family("box/one")) == "1 part, 3 parameters, linear in its parameters"


def test_the_page_draws_twelve_shapes_upright_with_equal_axes():
    drawing = gallery.figure(RIG)
    meshes = drawing.data[1:]
    assert [re.search("<b>(.*)</b>", mesh.hovertemplate)[1] for mesh in meshes] == list(RIG.part_names)
    assert sum(len(mesh.i) for mesh in meshes) == 12 * len(RIG.triangles)
    assert sum(len(mesh.x) for mesh in meshes) == 12 * len(RIG.vertex_part)
    assert min(min(mesh.z) for mesh in meshes) == pytest.approx(-0.5)
    scene = drawing.layout.scene
    spans = {axis: scene[f"{axis}axis"].range[1] - scene[f"{axis}axis"].range[0] for axis in "xyz"}
    units = [spans[axis] / scene.aspectratio[axis] for axis in "xyz"]
    np.testing.assert_allclose(units, units[0])
    for mesh in meshes:
        for axis in "xyz":
            low, high = scene[f"{axis}axis"].range
            assert low < min(mesh[axis]) <= max(mesh[axis]) < high, "plotly would cut it off"
        assert len(mesh.intensity) == len(mesh.i)


def test_a_page_alone_needs_no_network_and_tells_everything(tmp_path):
    gallery.write_page(RIG.name, tmp_path / "a.html")
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert len(page) > 3_000_000, "plotly itself is inside"
    assert not re.search(r'src="https?:', page)
    assert page.count('<img alt="five shapes') == page.count('" src="data:image/png') == len(RIG.parameters)
    assert '<html lang="en">' in page
    assert 'aria-label="12 random shapes of carton/two_flaps' in page
    assert all(one.meaning in page for one in RIG.parameters)
    assert f"{sheets.shapes(RIG)[11, 2]:.3f}" in page


def test_all_sheets_of_a_folder_share_one_plotly(tmp_path):
    names = catalogue.chosen(["carton/two_flaps", "box"])
    assert names == ("carton/two_flaps", "box/one")
    catalogue.write_sheets(names, tmp_path / "new")
    folder = tmp_path / "new"
    written = {path.name for path in folder.iterdir()}
    assert written == {
        "index.html",
        "overview.png",
        "plotly.min.js",
        *(f"{one}{end}" for one in ("carton_two_flaps", "box_one") for end in (".png", ".html", "_small.png")),
    }
    assert len((folder / "box_one.html").read_bytes()) < 1_000_000
    assert 'src="plotly.min.js"' in (folder / "box_one.html").read_text(encoding="utf-8")
    index = (folder / "index.html").read_text(encoding="utf-8")
    for target in re.findall(r'(?:src|href)="(.*?)"', index):
        assert (folder / target).is_file()
    for picture in folder.glob("*.png"):
        assert (np.asarray(Image.open(picture).convert("RGB")) < 200).any()


def test_no_sheet_is_written_if_a_name_is_unknown(tmp_path):
    with pytest.raises(ValueError, match=r"family: a family must be one of .*, got 'box/two'; check"):
        catalogue.write_sheets(["box/one", "box/two"], tmp_path / "new")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("seed", [-1, 0.5])
def test_no_sheet_is_written_of_a_bad_seed(tmp_path, seed):
    with pytest.raises(ValueError, match=f"sheet: seed must be a whole number >= 0, got {seed}; choose one"):
        catalogue.write_sheets(["box/one"], tmp_path / "new", seed)
    assert not list(tmp_path.iterdir())


def test_no_sheet_is_written_where_a_file_is_in_the_place_of_the_folder(tmp_path):
    (tmp_path / "mine").write_text("mine", encoding="utf-8")
    with pytest.raises(ValueError, match=r"sheet: .*mine must be a folder, got a file; choose another name for the"):
        catalogue.write_sheets(["box/one"], tmp_path / "mine" / "sheets")
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


def test_all_families_are_chosen_where_none_is_named():
    assert catalogue.chosen(()) == data_gen.families()


def test_a_family_in_words_names_all_it_has():
    said = describe.family(RIG.name)
    for joint in RIG.joint_list:
        assert f"hinge {joint.name}: {', '.join(joint.parts)} on {joint.on}" in said
    assert all(one.meaning in said for one in RIG.parameters)
    assert "flap_left / flap_right" in said
    for contact in (own := data_gen.family("table/four_legs")).contacts:
        assert f"{contact.first} - {contact.second} ({contact.kind})" in describe.family(own.name)
    assert own.contacts
