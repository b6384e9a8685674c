"""What airplanes are made of: bodies lofted along z, wings along x, fins along y, engines, propellers, wheels.

A rib is five numbers, (x, y, front, chord, thickness): a cut across a wing at x, whose round edge is at z = front.
"""

import numpy as np

from data_gen.part import Section, Tip, cylinder, ellipse, joined, loft, mirrored, moved, section
from data_gen.rig import Parameter

MEANINGS = {
    "wing_span": "from wing tip to wing tip along x",
    "wing_chord": "edge of a wing along z at its root",
    "tip_chord": "edge of a wing along z at its tip",
    "wing_sweep": "how far the front of a wing's tip lies behind the front of its root",
    "wing_rise": "how far a wing's tip lies above its root",
    "wing_gap": "from the lower wing up to the upper one",
    "fuselage_length": "from nose to tail along z",
    "fuselage_width": "edge of the fuselage along x",
    "fin_height": "from the foot of the fin to its upper end",
    "fin_lean": "how far the upper end of a fin lies outside its foot",
    "stabilizer_span": "from tip to tip of the stabilizers along x",
    "engine_length": "edge of an engine along z",
    "engine_diameter": "edge of an engine along y",
    "propeller_diameter": "from tip to tip of the blades",
    "gear_height": "from the middle of the fuselage down to the lower side of wheels or floats",
    "float_length": "edge of a float along z",
}
HALF = np.array([(0.26, 0.47), (0.42, 0.38), (0.5, 0.22), (0.42, -0.1), (0.06, -0.5)])
AIRFOIL = np.concatenate([[(0, 0.5)], HALF, HALF[::-1] * [-1, 1]])
"""An outline (11, 2) across a wing: q along its thickness, r to the front, where it is round."""
JET = ((0.2, 0.5), (0, 0.78), (0.03, 0.9), (0.14, 1), (0.45, 1), (0.8, 0.78), (0.8, 0.5), (1, 0.34))
"""A turbofan, (share of its length, share of its diameter), from inside the intake around its lip to the rear."""
BLADE = ((0.03, 0.05), (0.15, 0.1), (0.35, 0.11), (0.5, 0.05))
"""A propeller's blade, (distance from the axis, width), both as shares of the diameter."""
THIN = 0.007


def ranges(**ends):
    """Parameters of airplanes by name, each with the ends of its range."""
    return tuple(Parameter(name, low, high, MEANINGS[name]) for name, (low, high) in ends.items())


def body(name, rows, outline=None):
    """A loft along z, from front to rear, over rows (z, y, width, height), or (z, y) for a tip; round by itself."""
    sections = [section("z", (0, y, z), size) if size else Tip((0, y, z)) for z, y, *size in rows]
    return loft(name, sections, ellipse(16) if outline is None else outline)


def rows_at(rows, z, unit, y=0):
    """Rows (back, up, width, height), all in one unit, set at z and y; `back` counts towards the tail."""
    return [(z - back * unit, y + up * unit, *(edge * unit for edge in size)) for back, up, *size in rows]


def fuselage(p, nose, tail, outline=None):
    """The body between a nose and a tail, both rows in units of its width, the tail's counted from its end."""
    end, width = p.fuselage_length / 2, p.fuselage_width
    rows = (*rows_at(nose, end, width), *rows_at(tail, -end, width))
    return body("fuselage", rows, outline)


def windshield(rows):
    """The rows of a band of glass that stands a little out of the upper half of these rows."""
    return [(back, up + 0.2 * height, 0.96 * width, 0.65 * height) for back, up, width, height in rows]


def between(one, other, share):
    """The numbers `share` of the way from one rib to another."""
    return tuple(a + share * (b - a) for a, b in zip(one, other, strict=True))


def wing(p, x, y, front, thickness):
    """The ribs at the root and at the tip of a straight right wing."""
    tip = (p.wing_span / 2, y + p.wing_rise, front - p.wing_sweep, p.tip_chord, 0.4 * thickness)
    return (x, y, front, p.wing_chord, thickness), tip


def rib(x, y, front, chord, thickness):
    """The section of a wing."""
    return section("x", (x, y, front - chord / 2), (thickness, chord))


def winglet(x, y, front, chord, thickness):
    """Sections that go on from a rib at a wing's tip and turn up."""
    turn = 0.7 * thickness
    corner = Section((x + 0.2 * chord, y + 0.1 * chord, front - 0.55 * chord), (-turn, turn, 0), (0, 0, 0.9 * chord))
    return corner, Section(
        (x + 0.4 * chord - 0.004, y + chord, front - 1.1 * chord), (-0.008, 0, 0), (0, 0, 0.5 * chord)
    )


def pair(name, sections, outline=AIRFOIL):
    """The left and the right of a surface, made from the sections of the right one."""
    right = loft(f"{name}_right", sections, outline)
    return mirrored(right, f"{name}_left"), right


def two(right):
    """A numbered part at the right, and its mirror image under the next number."""
    kind, number = right.name.rsplit("_", 1)
    return right, mirrored(right, f"{kind}_{int(number) + 1}")


def stabilizers(p, x, y, front, chord):
    """Swept and tapered stabilizers, the right root at x."""
    tip = (p.stabilizer_span / 2, y, front - 0.6 * chord, 0.5 * chord, 0.008)
    return pair("stabilizer", [rib(x, y, front, chord, 0.012), rib(*tip)])


def fin(name, low, high):
    """An upright fin between two ribs, whose thickness is along x."""
    cuts = [section("y", (x, y, front - chord / 2), (thick, chord)) for x, y, front, chord, thick in (low, high)]
    return loft(name, cuts, AIRFOIL)


def jet(name, at, length, diameter):
    """A turbofan whose front is at a point."""
    x, y, front = at
    rows = [(front - back * length, y, edge * diameter, edge * diameter) for back, edge in JET]
    return moved(body(name, rows), by=(x, 0, 0))


def bar(name, low, high, size):
    """A straight strut between two points at different heights, of one size (x, z)."""
    return loft(name, [section("y", low, size), section("y", high, size)], ellipse(8))


def propeller(name, at, diameter, blades):
    """Blades around a pointed hub that ends at a point; the first blade stands upright."""
    x, y, z = at
    hub = [(z + 0.14 * diameter, y), (z + 0.09 * diameter, y, 0.07 * diameter, 0.07 * diameter)]
    hub = moved(body("hub", [*hub, (z, y, 0.12 * diameter, 0.12 * diameter)]), by=(x, 0, 0))
    around = [np.pi / 2 + 2 * np.pi * i / blades for i in range(blades)]
    return joined(name, hub, *(_blade((x, y, z + 0.03 * diameter), diameter, turn) for turn in around))


def _blade(middle, diameter, turn):
    x, y, z = middle
    c, s = np.cos(turn).round(15), np.sin(turn).round(15)
    at = [(x + c * away * diameter, y + s * away * diameter, z) for away, _ in BLADE]
    across = [(-s * width * diameter, c * width * diameter, 0) for _, width in BLADE]
    return loft("blade", [Section(a, b, (0, 0, THIN)) for a, b in zip(at, across, strict=True)], ellipse(8))


def wheeled(name, top, foot, wheel):
    """A leg from its top to a wheel, by the lowest point of the wheel and its diameter."""
    x, y, z = foot
    hub = (x, y + wheel / 2, z)
    return joined(name, bar("leg", hub, top, (0.012, 0.016)), cylinder("wheel", hub, (0.4 * wheel, wheel, wheel), "x"))
