"""Every fault that an author can build into a rig has its sentence, and sound rigs have none."""

import re

import numpy as np
import pytest

import data_gen
from data_gen.faults import faults
from data_gen.joint import hinge
from data_gen.part import box
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


def test_what_may_hang_or_fly_need_not_stand():
    def hung(p):
        return (box("shade", (0, -FLOOR - p.height / 2, 0), (p.width, p.height, 0.2)),)

    def flying(p):
        return (box("body", (0, 0, 0), (p.width, p.height, 0.2)),)

    assert faults(Rig("lamp/one", SIZES, hung)) == []
    assert faults(Rig("airplane/one", SIZES, flying)) == []
    assert "it must stand" in faults(Rig("lamp/two", SIZES, flying))[0]


def test_the_same_seed_finds_the_same():
    tried = rig(lambda p: post(p, gap=0.1 * (p.width - 0.3)))
    assert faults(tried, seed=1) == faults(tried, seed=1) != []
    assert np.isfinite(tried.middle).all()
