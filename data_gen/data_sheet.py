"""The data sheet of a folder of data sets: what each file stands in for and how it differs, read off the files."""

import hashlib
import json
import zipfile
from itertools import groupby

import numpy as np

from data_gen.files import beside

HEAD = """# Counterparts of the data sets of the DeformSyncNet paper

Section 4 of *DeformSyncNet: Deformation Transfer via Synchronized Shape Deformation Spaces* (Sung, Jiang, Achlioptas,
Mitra and Guibas, SIGGRAPH Asia 2020) uses data that cannot be passed on with a course. These files stand in for it.
They were made by `python -m data_gen paper --out FOLDER` and hold procedural shapes only.

- **What is the same**: how many shapes, how many points on each, how they are split, what is normalised and what is
  not.
- **What differs everywhere**: shapes are drawn uniformly from the ranges of hand-written families; real collections
  are uniform in nothing. Parts are clean closed surfaces that touch; modelled or scanned ones overlap, gape and have
  insides. All faces are sampled, also those where parts touch. And all is known: parameters, parts, their boxes and,
  inside a family, correspondences.
- **Read a file** with `data_gen.load` or `dsn_lite.load_shapes`; `data_gen/sample.py` describes the keys. Its split
  is in it: `shapes.split()` gives training, validation and test shapes. y is up, the front looks towards +z.
- **Make a file again** with the same command: the same seed gives the same shapes, and on one machine the same bytes.
- **Licence**: MIT, as the code that made them. Nothing in them comes from third parties.
"""
GROUPS = {
    "categories": (
        "Section 4.1: five categories",
        """Stand in for ShapeNet (Chang et al. 2015), as the paper preprocessed it, with its counts and its split
85-5-10. Each file mixes the families of a category at random, 2 to 16 parts, inside [-0.5, 0.5], sizes not normalised
one by one. Differences: a category is a dozen or so structures, not hundreds; the parts and their boxes are the true
ones, where the paper merges components and fits boxes with trimesh; samples are new for each shape, as there.""",
    ),
    "normalised": (
        "Section 4.2: five categories, each cloud in a cube of its own",
        """Stand in for ShapeNet as Groueix et al. (2019) preprocessed it: other shapes of the same families, each
cloud centred and scaled alike along all axes, so that the longest edge of its bounding box is 2. Differences: as
above. The paper gives no counts for this set; these are those of section 4.1, and 1500 lamps. As sizes are gone, so
are boxes and joints; labels are there, for mIoU.""",
    ),
    "parametric": (
        "Section 4.3: parametric models",
        """Stand in for the 74 parametric models of Schulz et al. (2017): one family a file, none with joints, 1000
variants with random parameters, 128 of them for testing. All shapes of a file have the same samples, drawn on the
shape in the middle of the ranges: points correspond by index, which is for evaluation, not for training. Differences:
theirs are CAD models with their own parametrisations; here every point is a linear function of the parameters. The
paper names no validation shapes; we take 50 of its training shapes. Its user study takes 8 models each of airplanes,
chairs and tables: they are among these.""",
    ),
    "tables": (
        "Section 4.4: procedural tables",
        """Stand in for the procedural table of Tian et al. (2019): a rectangular top and four legs at its corners,
5000 random samples. Differences: the parameters and ranges are ours. The paper trains on all 5000 and tests by
perturbing one shape; here 15 percent are kept for validation and test.""",
    ),
    "poses": (
        "Section 4.6: poses of articulated models",
        """Stand in for three models of Shape2Motion (Wang et al. 2019): one carton, one pair of eyeglasses, one
swing, 1000 poses each, 128 for testing. Only the angles vary, uniformly in their ranges; all other parameters are in
the middle of theirs. Differences: theirs are modelled by hand; the number of hinges is ours (4, 2 and 2). Samples are
new for each pose; the paper does not say. Validation shapes as above.""",
    ),
}
COLUMNS = "| file | families | shapes | at full scale | train / validation / test | points | sampling | seed | MB |"


def write_sheet(folder, data_sets):
    """Write README.md in a folder: a row for each data set that lies there, and the SHA-256 of every file."""
    there = [one for one in data_sets if (folder / f"{one.name}.npz").is_file()]
    parts = [_group(folder, name, list(own)) for name, own in groupby(there, key=lambda one: one.group)]
    sums = [f"{_sum(folder / f'{one.name}.npz')}  {one.name}.npz" for one in there]
    check = "## Check\n\nThe SHA-256 of each file, as `sha256sum` writes it:\n\n```\n" + "\n".join(sums) + "\n```\n"
    with beside(folder / "README.md") as part:
        part.write_text("\n".join([HEAD, *parts, check]), encoding="utf-8")


def _group(folder, name, data_sets):
    title, text = GROUPS[name]
    rule = "|".join(["", *["---"] * (COLUMNS.count("|") - 1), ""])
    return "\n".join([f"## {title}\n\n{text}\n", COLUMNS, rule, *(_row(folder, one) for one in data_sets), ""])


def _row(folder, one):
    path = folder / f"{one.name}.npz"
    about, (count, points, _) = _told(path)
    split = " / ".join(str(np.ptp(about["split"][part])) for part in ("train", "validation", "test"))
    families, size = len(about.get("families", [one.family])), path.stat().st_size / 1e6
    named = one.family if families == 1 else f"{families} of {one.family}"
    cells = (f"{one.name}.npz", named, count, one.count, split, points, about["sampling"], about["seed"], f"{size:.1f}")
    return f"| {' | '.join(str(cell) for cell in cells)} |"


def _told(path):
    """What a file says about itself, and the shape of its points, which are not read."""
    with zipfile.ZipFile(path) as archive:
        with archive.open("about.npy") as member:
            about = json.loads(str(np.lib.format.read_array(member)))
        with archive.open("points.npy") as member:
            np.lib.format.read_magic(member)
            return about, np.lib.format.read_array_header_1_0(member)[0]


def _sum(path):
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
