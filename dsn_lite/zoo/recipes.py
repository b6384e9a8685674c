"""What each ready-made space was made from, and what it should not be trusted with."""

from dataclasses import dataclass

MIXED = "--k 64 --sparsity 10 --symmetry 1 --steps {} --seed 0"  # the paper's k, weights and losses (Section 4.1)
FOREIGN = (
    "Shapes from other sources: it has seen {} made of clean parts, upright, all at one scale; real ones come part of "
    "the way to their target. {} Train on your own kind of thing where you can."
)


@dataclass(frozen=True)
class Recipe:
    """What data_gen generates, what dsn_lite train is told, and what the result should not be trusted with."""

    generate: str
    train: str
    bad_at: str


def mixed(category: str, steps: int, said: str, *, kind: str) -> Recipe:
    """One network of all families of a category, with part handles and the paper's sparsity."""
    generate = f"{category} --count 4000 --points 2048 --seed 0"
    return Recipe(generate, MIXED.format(steps), FOREIGN.format(kind, said))


RECIPES = {
    "airplane": mixed(
        "airplane", 6000, "Number and place of engines do not change, wings do not appear or vanish.", kind="airplanes"
    ),
    "car": mixed("car", 6000, "A roof does not appear on an open car, nor a cabin on a trailer.", kind="cars"),
    "chair": mixed(
        "chair",
        8000,
        "Parts that one chair has and the other lacks (arms, rockers, castors) are not made.",
        kind="chairs",
    ),
    "lamp": mixed(
        "lamp", 6000, "Hanging and standing lamps are far apart: between them it only moves points about.", kind="lamps"
    ),
    "sofa": mixed("sofa", 6000, "Numbers of cushions and legs do not change.", kind="sofas"),
    "table": mixed(
        "table", 8000, "Round tops stay round and drawers stay; legs do not become trestles.", kind="tables"
    ),
    "table_four_legs": Recipe(
        "table/four_legs --count 2000 --points 2048 --seed 0",
        "--k 32 --steps 12000 --seed 0",
        "Tables unlike its own: round tops, crossed or tapered legs, drawers, shelves. It has seen parts only as boxes "
        "parallel to the axes, so a leg that leans is moved as if it stood upright. Tables from other sources come "
        "only part of the way to their target: look at the result, and train on your own kind of thing.",
    ),
}
