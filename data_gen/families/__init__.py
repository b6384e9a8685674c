"""The families, one file per category. All stand on the floor y = -0.5, y up, front towards +z, centred in x and z."""

from data_gen.families import box, chair, table

RIGS = {rig.name: rig for rig in (*table.FAMILIES, *chair.FAMILIES, *box.FAMILIES)}


def families(category=None):
    """Names of all families, or of one category's: `families("table")`. Raises ValueError for an unknown category."""
    names = tuple(name for name in RIGS if category in (None, name.split("/")[0]))
    if not names:
        categories = ", ".join(dict.fromkeys(name.split("/")[0] for name in RIGS))
        raise ValueError(f"families: a category must be one of {categories}, got {category!r}; see families()")
    return names


def family(name):
    """The rig called `name`. Raises ValueError for an unknown name."""
    if name not in RIGS:
        raise ValueError(f"family: a family must be one of {', '.join(RIGS)}, got {name!r}; check the spelling")
    return RIGS[name]
