"""Every fault that an author can build into a rig has its sentence, and sound rigs have none."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import data_gen
from data_gen.faults import faults
from data_gen.joint import hinge
from data_gen.part import ball, box, joined, mirrored, moved
from data_gen.rig import FLOOR, Contact, Parameter, Rig

SIZES = tuple(Parameter(name, 0.2, 0.4, f"edge along {axis}") for name, axis in (("width", "x"), ("height", "y")))
MIDDLE = (("foot", "foot"), ("post", "post"))
ON_IT = (Contact("foot", "post", "face_y"),)


def post(p, gap=0.0, aside=0.0, width=None, depth=0.2, floor=0.0):
    """A post on a foot."""
    bottom = FLOOR + floor + 0.1
    foot = box("foot", (0, FLOOR + floor + 0.05, 0), (p.width if width is None else width, 0.1, 0.2))
    return foot, box("post", (aside, bottom + gap + p.height / 2, 0), (0.1, p.height, depth))


def rig(build=post, parameters=SIZES, symmetric=MIDDLE, contacts=ON_IT):
    return Rig("post/one", parameters, build, symmetric, contacts)


def turning(p, aside=0.0):
    """A post whose upper part turns about its lower end."""
    foot, upper = post(p)
    return foot, upper, hinge("knee", ["post"], "foot", (0, 0, 1), (aside, FLOOR + 0.1, 0), p.width)


def pendulum(p):
    """A long post that is inside the bounds at the ends of its turn, and reaches out between them if it is longest."""
    foot, length = box("foot", (0, FLOOR + 0.05, 0), (0.1, 0.1, p.height)), 0.7 + p.width
    return foot, box("post", (0, FLOOR + 0.1 + length / 2, 0), (0.1, length, 0.1)), knee(angle=p.angle)


SWING = (Parameter("width", 0.1, 0.1987, ""), SIZES[1], Parameter("angle", -0.5, 0.5, "", "rad"))


def knee(name="knee", parts=("post",), on="foot", axis=(0, 0, 1), angle=0.1):
    return hinge(name, parts, on, axis, (0, FLOOR + 0.1, 0), angle)


def hung(*joints):
    """A post on a foot with a cap, and joints."""
    return rig(lambda p: (*post(p), box("cap", (0, 0.3, 0), (0.1, 0.1, 0.1)), *joints))


def width(low, high):
    return rig(parameters=(SIZES[0]._replace(low=low, high=high), SIZES[1]))


MISFORMED = {
    r'name must be "category/family", with one slash, got \'post\'$': replace(rig(), name="post"),
    r"name must be .* got 'post/'": replace(rig(), name="post/"),
    r"name must be .* got None": replace(rig(), name=None),
    r"parameters must hold Parameters, got 'width'; write \(Parameter\(\"width\", 0\.2": rig(parameters=SIZES[0]),
    r"parameters must hold Parameters, got \('width', 0\.2, 0\.4\)": rig(parameters=(("width", 0.2, 0.4),)),
    r'contacts must hold Contacts, got \(\'foot\', \'post\'\); write \(Contact\("a"': rig(contacts=(("foot", "post"),)),
    r"contacts must hold Contacts, got 'foot'": rig(contacts=ON_IT[0]),
    r"contacts must hold Contacts, got None": rig(contacts=None),
    r"symmetric must hold pairs of names, got 'foot'; write": rig(symmetric=("foot", "foot")),
    r"there must be a parameter or more, got none": rig(lambda p: post(SIZES[0], width=1), ()),
    r"two parameters are called width": rig(parameters=(*SIZES, SIZES[0])),
    r"parameter width must have low < high, two numbers, got \[0\.4, 0\.2\]": width(0.4, 0.2),
    r"parameter width must have low < high, two numbers, got \[0\.3, 0\.3\]": width(0.3, 0.3),
    r"parameter width must have low < high, two numbers, got \[0\.3, inf\]": width(0.3, np.inf),
    r"parameter width must have low < high, two numbers, got \[a, 0\.3\]": width("a", 0.3),
    r"build asks for p\.wide, but the parameters are width, height$": rig(lambda p: post(p, width=p.wide)),
    r"build must return a tuple of parts and joints, got a Part; .*comma": rig(lambda p: post(p)[0]),
    r"build must return a tuple of parts and joints, got None; end it with return": rig(lambda p: None),
    r"build must return parts and joints, got a tuple among them; write \*": rig(lambda p: (post(p),)),
    r"there must be 1 to 16 parts, got 0": rig(lambda p: ()),
    r"there must be 1 to 16 parts, got 17": rig(
        lambda p: [box(f"box_{i}", (0, 0, 0), (p.width, p.height, 0.2)) for i in range(17)]
    ),
    r"there must be at most 32767 triangles, got 39\d\d\d": rig(
        lambda p: (post(p)[0], ball("post", (0, 0, 0), (0.1, p.height, 0.1), 200, 100))
    ),
    r"two parts are called foot; give each": rig(lambda p: (post(p)[0], post(p)[0])),
    r"two joints are called knee; give each": hung(knee(), knee(parts=("cap",))),
    r"joints names the part 'leg', but": hung(knee(on="leg")),
    r"^hinge knee: axis must be three numbers, not all 0, got": rig(lambda p: (*post(p), knee(axis=(0, 0, 0)))),
    r"hinge knee moves no part": hung(knee(parts=())),
    r"hinge knee hangs post on itself": hung(knee(on="post")),
    r"part post is moved by both knee and hip; name it in one": hung(knee(), knee("hip", on="cap")),
    r"hinge hip stands before knee, which carries it": hung(knee("hip", ("cap",), "post"), knee()),
    r"hinge knee hangs on a part that it moves itself, in a": hung(knee(on="cap"), knee("hip", ("cap",), "post")),
}  # fmt: skip


@pytest.mark.parametrize("sentence", MISFORMED)
def test_what_has_not_the_form_of_a_rig_is_said_in_one_sentence(sentence):
    (fault,) = [one for one in faults(MISFORMED[sentence]) if not one.startswith("hinge hip hangs on a part that it")]
    assert re.search(sentence, fault)


def test_a_mistake_in_build_itself_keeps_its_traceback():
    with pytest.raises(AttributeError, match="'tuple' object has no attribute 'name'"):
        faults(rig(lambda p: post(p).name))
    with pytest.raises(ValueError, match="operands could not be broadcast"):
        faults(rig(lambda p: post(p, width=np.ones(2) + np.ones(3))))


WRONG = {
    r"contacts names the part 'top', but the parts are foot, post": rig(contacts=(Contact("foot", "top", "face_y"),)),
    r"symmetric names the part 'leg'": rig(symmetric=(("foot", "leg"),)),
    r"the contact of foot and post must be one of face_x, face_y": rig(contacts=(Contact("foot", "post", "y"),)),
    r"part foot is not linear in the parameters; only add": rig(lambda p: post(p, width=p.width * p.height * 5)),
    r"a joint is not linear": rig(
        lambda p: (*post(p), hinge("knee", ["post"], "foot", (0, 0, 1), (0, FLOOR + 0.1, 0), p.width**2))
    ),
    r"parameter width changes nothing": rig(lambda p: post(p, width=0.3)),
    r"two parameters do the same thing": rig(
        lambda p: post(p, width=p.width + p.depth), (*SIZES, SIZES[0]._replace(name="depth"))
    ),
    r"part post reaches y = 0\.8, outside \[-0\.5, 0\.5\]": rig(parameters=(SIZES[0], SIZES[1]._replace(high=1.2))),
    r"part foot reaches x = -?0\.75, outside": rig(parameters=(SIZES[0]._replace(high=1.5), SIZES[1])),
    r"part post can get 0\.001 thin along z; keep it above 0\.004": rig(lambda p: post(p, depth=0.001)),
    r"part post can turn inside out": rig(lambda p: post(p, depth=p.width - 0.3, width=0.3)),
    r"it must stand on y = -0\.5, always, but its lowest point is at -0\.3": rig(lambda p: post(p, floor=p.width)),
    r"foot and post are 0\.01 apart where they should touch \(face_y\)": rig(lambda p: post(p, gap=0.01)),
    r"foot and post run 0\.01 into each other where they": rig(lambda p: post(p, gap=-0.01)),
    r"foot and post lie beside each other along x, so they do not touch": rig(lambda p: post(p, aside=0.3)),
    r"post should mirror across x = 0, off by 0\.02": rig(lambda p: post(p, aside=0.01)),
    r"part post reaches y = 0\.5000\d+, outside": rig(pendulum, SWING),
    r"hinge knee lies 0\.35 beside foot or beside what it moves": rig(lambda p: turning(p, aside=0.4)),
}  # fmt: skip


@pytest.mark.parametrize("sentence", WRONG)
def test_every_fault_is_said(sentence):
    assert any(re.search(sentence, fault) for fault in faults(WRONG[sentence]))


@pytest.mark.parametrize("sound", [rig(), rig(turning), *map(data_gen.family, ["table/shelf", "carton/two_flaps"])])
def test_sound_rigs_have_none(sound):
    assert faults(sound) == []


def test_a_pair_of_two_is_named_by_both():
    def pair(p):
        places = (("a", 0.2), ("b", -0.3))
        return tuple(box(name, (x, FLOOR + p.height / 2, 0), (0.1, p.height, p.width)) for name, x in places)

    (fault,) = faults(rig(pair, symmetric=(("a", "b"),), contacts=()))
    assert fault == "a and b should mirror across x = 0, off by 0.1"


@pytest.mark.parametrize("pair", [("a", "b"), ("b", "a")])
def test_a_mirror_image_with_more_to_it_is_none(pair):
    def more(p):
        one = box("a", (0.3, FLOOR + p.height / 2, 0), (0.1, p.height, p.width))
        other = mirrored(one, "b")
        return one, joined("b", other, moved(other, by=(0.15, 0, 0)))

    (fault,) = faults(rig(more, symmetric=(pair,), contacts=()))
    assert fault == f"{' and '.join(pair)} should mirror across x = 0, off by 0.15"


def test_a_mirror_image_at_one_shape_only_is_none():
    def pair(p):
        told = (("a", 0.3, p.width), ("b", -0.3, p.height))
        return tuple(box(name, (x, FLOOR + 0.1, 0), (0.1, 0.2, edge)) for name, x, edge in told)

    (fault,) = faults(rig(pair, symmetric=(("a", "b"),), contacts=()))
    assert fault == "a and b should mirror across x = 0, off by 0.1"


def test_what_may_hang_or_fly_need_not_stand():
    def hung(p):
        return (box("shade", (0, -FLOOR - p.height / 2, 0), (p.width, p.height, 0.2)),)

    def flying(p):
        return (box("body", (0, 0, 0), (p.width, p.height, 0.2)),)

    assert faults(Rig("lamp/one", SIZES, hung)) == []
    assert faults(Rig("airplane/one", SIZES, flying)) == []
    assert "it must stand" in faults(Rig("lamp/two", SIZES, flying))[0]


def test_the_same_seed_finds_the_same_and_another_one_tries_other_shapes():
    names = [f"length_{i}" for i in range(20)]
    many = tuple(Parameter(name, 0.1, 0.2, "any") for name in names)

    def apart(p):  # nowhere as far as at one corner of a million, and not at all where all are low or all high
        gap = sum((-1) ** i * getattr(p, name) for i, name in enumerate(names))
        return post(SimpleNamespace(width=p.length_0, height=p.length_1), gap=gap)

    one, same, other = (faults(rig(apart, many), seed) for seed in (1, 1, 2))
    assert one == same != other
