"""Families in words, for the command line."""

from data_gen.families import family as rig_of
from data_gen.joint import parents
from data_gen.sheet import range_of, sort_of


def line(name):
    """A family in one line."""
    return f"{name:<28} {sort_of(rig_of(name))}"


def family(name):
    """All there is to know about a family."""
    rig = rig_of(name)
    said = [line(name), f"  parts: {', '.join(rig.part_names)}", "  parameters:"]
    said += [f"    {one.name:<20} {range_of(one):<34} {one.meaning}" for one in rig.parameters]
    said += [f"  mirrored pairs: {', '.join(_pair(*pair) for pair in rig.symmetric) or 'none'}"]
    said += [f"  touching: {', '.join(f'{one} - {other} ({kind})' for one, other, kind in rig.contacts) or 'none'}"]
    for joint, parent in zip(rig.joint_list, parents(rig.joint_list), strict=True):
        carried = f", carried by {rig.joint_list[parent].name}" if parent >= 0 else ""
        said += [f"  {joint.kind} {joint.name}: {', '.join(joint.parts)} on {joint.on}{carried}"]
    return "\n".join(said)


def _pair(one, other):
    return one if one == other else f"{one} / {other}"
