"""What of a rig has not the form of one, in sentences: names, ranges, what `build` returns, chains of joints."""

from collections import Counter
from numbers import Real
from types import SimpleNamespace

import numpy as np

from data_gen.fits import SIDES
from data_gen.joint import HINGE, SLIDE, Joint, parents
from data_gen.part import Part
from data_gen.rig import Contact, Parameter

MOST_PARTS, MOST_TRIANGLES = 16, 2**15 - 1


def misformed(rig):
    """Sentences, none where the rig can be tried. Each step counts on those before it."""
    for step in (_not_declared, _badly_declared, _not_built, _badly_built, _unknown, _badly_hung):
        if found := list(step(rig)):
            return found
    return []


def _not_declared(rig):
    """What is of another kind than the fields of a rig hold."""
    if not isinstance(rig.name, str) or [bool(word) for word in rig.name.split("/")] != [True, True]:
        yield f'name must be "category/family", with one slash, got {rig.name!r}'
    held = {"parameters": (Parameter, '"width", 0.2, 0.4, "edge along x"'), "contacts": (Contact, '"a", "b", "face_y"')}
    for field, (kind, example) in held.items():
        for one in _strange(rig, field, lambda one, kind=kind: isinstance(one, kind)):
            yield f"{field} must hold {kind.__name__}s, got {one!r}; write ({kind.__name__}({example}),)"
    for one in _strange(rig, "symmetric", lambda one: isinstance(one, tuple | list) and len(one) == 2):
        yield f'symmetric must hold pairs of names, got {one!r}; write (("a", "b"),) with both commas'


def _strange(rig, field, known):
    """What a field holds that should not be there, the first of it; the field itself where it holds nothing at all."""
    held = getattr(rig, field)
    return [one for one in held if not known(one)][:1] if isinstance(held, tuple | list) else [held]


def _badly_declared(rig):
    if not rig.parameters:
        yield "there must be a parameter or more, got none; without one all shapes are the same"
    yield from (f"two parameters are called {name}; give each its own name" for name in _twice(rig.parameter_names))
    for name, low, high, *_ in rig.parameters:
        numbers = all(isinstance(end, Real) and np.isfinite(end) for end in (low, high))
        if not numbers or low >= high:
            yield f"parameter {name} must have low < high, two numbers, got [{low}, {high}]"
    for contact in rig.contacts:
        if contact.kind not in SIDES:
            yield f"the contact of {contact.first} and {contact.second} must be one of {', '.join(SIDES)}"


def _not_built(rig):
    """What `build` asks for in vain, and what it returns that is neither part nor joint."""
    try:
        built = rig.in_the_middle
    except AttributeError as error:
        if not isinstance(error.obj, SimpleNamespace):
            raise
        yield f"build asks for p.{error.name}, but the parameters are {', '.join(rig.parameter_names)}"
        return
    except ValueError as error:
        if not str(error).startswith((HINGE, SLIDE)):
            raise  # its author needs the line where it happened
        yield str(error)
        return
    if not isinstance(built, tuple | list):
        cure = "end it with return" if built is None else "write a comma after a single part, as in (part,)"
        yield f"build must return a tuple of parts and joints, got {_kind(built)}; {cure}"
    elif strange := [one for one in built if not isinstance(one, Part | Joint)]:
        yield f"build must return parts and joints, got {_kind(strange[0])} among them; write * before a tuple of parts"


def _badly_built(rig):
    if not 1 <= len(rig.part_names) <= MOST_PARTS:
        yield f"there must be 1 to {MOST_PARTS} parts, got {len(rig.part_names)}; joined(...) makes one of several"
    elif len(rig.triangles) > MOST_TRIANGLES:
        yield f"there must be at most {MOST_TRIANGLES} triangles, got {len(rig.triangles)}; take fewer sides"
    yield from (f"two parts are called {name}; give each its own name" for name in _twice(rig.part_names))
    joints = _twice(joint.name for joint in rig.joint_list)
    yield from (f"two joints are called {name}; give each its own name" for name in joints)


def _unknown(rig):
    """Names that are declared but are no part's."""
    pairs = {"symmetric": rig.symmetric, "contacts": [contact[:2] for contact in rig.contacts]}
    pairs["joints"] = [(joint.on, *joint.parts) for joint in rig.joint_list]
    for where, declared in pairs.items():
        for name in sorted({name for pair in declared for name in pair} - set(rig.part_names)):
            yield f"{where} names the part {name!r}, but the parts are {', '.join(rig.part_names)}"


def _badly_hung(rig):
    carried = parents(rig.joint_list)
    for name in _twice(part for joint in rig.joint_list for part in dict.fromkeys(joint.parts)):
        first, second = [joint.name for joint in rig.joint_list if name in joint.parts][:2]
        yield f"part {name} is moved by both {first} and {second}; name it in one, and hang that one on the other"
    for j, joint in enumerate(rig.joint_list):
        what = f"{joint.kind} {joint.name}"
        if not joint.parts:
            yield f"{what} moves no part; name one in its parts"
        elif joint.on in joint.parts:
            yield f"{what} hangs {joint.on} on itself; hang it on another part"
        elif _in_a_circle(carried, j):
            yield f"{what} hangs on a part that it moves itself, in a circle; let one joint hang on what does not move"
        elif carried[j] > j:
            yield f"{what} stands before {rig.joint_list[carried[j]].name}, which carries it; return it after that one"


def _in_a_circle(carried, joint):
    above = carried[joint]
    for _ in carried:
        if above in (joint, -1):
            return above == joint
        above = carried[above]
    return False  # it hangs on a circle, but is not in it


def _twice(names):
    return [name for name, times in Counter(names).items() if times > 1]


def _kind(value):
    return "None" if value is None else f"a {type(value).__name__}"
