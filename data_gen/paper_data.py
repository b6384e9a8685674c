"""Counterparts of the data sets of the DeformSyncNet paper (section 4); `data_sheet.py` says how they differ."""

import zlib
from dataclasses import dataclass, replace
from pathlib import Path

from data_gen.archive import save
from data_gen.data_sheet import write_sheet
from data_gen.draw import FRESH, SHARED
from data_gen.families import families
from data_gen.families import family as rig_of
from data_gen.files import check_folder
from data_gen.make import generate
from data_gen.normalise import normalised

POINTS = 2048
CATEGORIES = {"airplane": 2390, "car": 1200, "chair": 1927, "sofa": 947, "table": 1857}
NORMALISED = {"airplane": 2390, "car": 1200, "chair": 1927, "lamp": 1500, "table": 1857}
"""The paper counts the first set only; lamps are our number."""
MODELS, VARIANTS = 74, 1000
GROUPED, IN_GROUP = ("airplane", "chair", "table"), 8
"""The paper's user study takes models of these categories, so many of each."""
POSED = ("carton/four_flaps", "eyeglasses/rectangular", "swing/double")
TABLES = 5000
VALIDATION, TEST, TEST_OF_MODELS = 0.05, 0.10, 0.128
LITE, FEWEST = 0.01, 8


@dataclass(frozen=True)
class DataSet:
    """One file: `count` shapes of a family or of a category, and which share of them is for testing.

    poses: only angles vary, the other parameters stay in the middle of their ranges. cubes: each cloud fills one.
    """

    name: str
    family: str
    count: int
    test: float = TEST
    sampling: str = FRESH
    poses: bool = False
    cubes: bool = False

    @property
    def group(self):
        """The folder it lies in."""
        return self.name.split("/")[0]

    @property
    def seed(self):
        """From its name, so that no two sets have the same shapes, whatever else is made."""
        return zlib.crc32(self.name.encode())

    def made(self, count):
        """The collection, of `count` shapes, and its split in `about`."""
        options = {"points": POINTS, "seed": self.seed, "sampling": self.sampling}
        shapes = generate(self.family, count=count, fixed=_lengths(self.family) if self.poses else None, **options)
        shapes = normalised(shapes) if self.cubes else shapes
        return replace(shapes, about={**shapes.about, "split": split(count, self.test)})


def data_sets():
    """Every data set, by the groups of the data sheet."""
    models = parametric_models()
    return (
        *(DataSet(f"categories/{name}", name, count) for name, count in CATEGORIES.items()),
        *(DataSet(f"normalised/{name}", name, count, cubes=True) for name, count in NORMALISED.items()),
        *(DataSet(f"parametric/{name.replace('/', '_')}", name, VARIANTS, TEST_OF_MODELS, SHARED) for name in models),
        DataSet("tables/four_legs", "table/four_legs", TABLES),
        *(DataSet(f"poses/{name.split('/')[0]}", name, VARIANTS, TEST_OF_MODELS, poses=True) for name in POSED),
    )


def paper(out, *, only=None, lite=False, progress=iter):
    """Write every data set, or `only` one of them or of their groups, to a folder, and a data sheet of what lies there.

    `lite` makes a hundredth of the shapes, for trials. `progress` wraps the data sets as they are made, as tqdm does.
    Raises ValueError for the name of no set.
    """
    chosen = [one for one in data_sets() if only in (None, one.name, one.group)]
    if not chosen:
        known = ", ".join(dict.fromkeys(one.group for one in data_sets()))
        raise ValueError(
            f"paper: only must name a data set, such as poses/carton, or one of {known}, got {only!r}; check it"
        )
    out = Path(out)
    check_folder(out, "paper")
    for one in progress(chosen):
        path = out / f"{one.name}.npz"
        path.parent.mkdir(parents=True, exist_ok=True)
        save(one.made(max(FEWEST, round(one.count * (LITE if lite else 1)))), path)
    write_sheet(out, data_sets())


def parametric_models():
    """Names of 74 families without joints, of two parts or more: those of the user study, then as evenly as it goes."""
    still = [name for name in families() if not rig_of(name).joint_list and len(rig_of(name).part_names) > 1]
    return sorted(sorted(still, key=_rank(still))[:MODELS], key=still.index)


def _rank(names):
    """What to sort families by: first the groups of the user study, then the first of each category, and so on."""
    places = {}
    for name in names:
        places[name] = sum(one.split("/")[0] == name.split("/")[0] for one in places)
    return lambda name: (name.split("/")[0] not in GROUPED or places[name] >= IN_GROUP, places[name])


def split(count, test):
    """Rows of training, validation and test shapes; shapes are drawn independently, so any rows are a random split."""
    stop = count - max(1, round(test * count))
    start = stop - max(2, round(VALIDATION * count))
    return {"train": [0, start], "validation": [start, stop], "test": [stop, count]}


def _lengths(family):
    """The middle of the range of every parameter that is no angle."""
    return {one.name: (one.low + one.high) / 2 for one in rig_of(family).parameters if one.unit != "rad"}
