"""The families, one file or folder a category. y is up, the front looks towards +z, the middle stands at x = 0.

Furniture and cars stand on the floor y = -0.5, lamps may hang from y = 0.5, airplanes fly at y = 0.
"""

from data_gen.families import (
    airplane,
    bed,
    bench,
    boat,
    bookcase,
    bottle,
    box,
    cabinet,
    cabinet_doors,
    car,
    carton,
    chair,
    desk_lamp,
    eyeglasses,
    folding_chair,
    lamp,
    laptop,
    mug,
    oven,
    scissors,
    sofa,
    stool,
    swing,
    table,
    vase,
)

RIGS = {
    rig.name: rig
    for category in (
        table,
        chair,
        sofa,
        lamp,
        airplane,
        car,
        bed,
        bench,
        stool,
        cabinet,
        bookcase,
        bottle,
        mug,
        vase,
        boat,
        carton,
        eyeglasses,
        swing,
        laptop,
        folding_chair,
        desk_lamp,
        scissors,
        cabinet_doors,
        oven,
        box,
    )
    for rig in category.FAMILIES
}


def families(category=None):
    """Names of all families, or of one category's: `families("table")`. Raises ValueError for an unknown category."""
    names = tuple(name for name in RIGS if category in (None, name.split("/")[0]))
    if not names:
        known = ", ".join(categories())
        raise ValueError(f"families: a category must be one of {known}, got {category!r}; see families()")
    return names


def categories():
    """Names of the categories."""
    return tuple(dict.fromkeys(name.split("/")[0] for name in RIGS))


def family(name):
    """The rig called `name`. Raises ValueError for an unknown name."""
    if not isinstance(name, str) or name not in RIGS:
        category = str(name).split("/")[0]
        known = families(category) if category in categories() else ("the families of " + ", ".join(categories()),)
        raise ValueError(f"family: a family must be one of {', '.join(known)}, got {name!r}; check the spelling")
    return RIGS[name]
