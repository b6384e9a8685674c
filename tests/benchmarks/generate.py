"""How fast shapes are made: data_gen against building each with trimesh, part by part, and sampling its surface.

    python tests/benchmarks/generate.py [FAMILY ...]        by default a table of boxes and a few of round parts
    python tests/benchmarks/generate.py all                 every linear family, fewer shapes: the worst and the median

One thread, one process. The slow way is timed on a part of the shapes and scaled up; the fast ways make them all.
trimesh is given the vertices of all parts for nothing; it only builds the meshes, joins them and samples. It takes its
time for a part, so the fewer the parts of a family, the smaller the ratio; a single box is the hardest.

Of a fresh table of 1024 points in about 0.1 ms, a fifth goes into random numbers, a third into finding the points'
triangles and shuffling them, the rest into reading triangles and boxes for every point.
"""

import os

os.environ.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"))

import platform
import sys
import time
import tracemalloc

import numpy as np
import trimesh

import data_gen

FAMILIES, COUNT, POINTS, TIMED, REPEATS = (
    ("table/four_legs", "table/pedestal", "chair/office", "box/one"),
    10_000,
    1024,
    200,
    3,
)
AT_LEAST = {"shared": 30, "fresh": 10}
ARRAYS = ("points", "labels", "rest", "faces", "weights", "boxes", "parameters", "joints")


def by_trimesh(rig, vertices, seed):
    """Points of one shape from its vertices (V, 3): a mesh a part, joined, sampled by area."""
    parts = []
    for i in range(len(rig.part_names)):
        own = rig.triangles[rig.triangle_part == i]
        parts.append(trimesh.Trimesh(vertices[rig.vertex_part == i], own - own.min()))
    points, _ = trimesh.sample.sample_surface(trimesh.util.concatenate(parts), POINTS, seed=seed)
    return points.astype(np.float32)


def seconds(work):
    """The shortest of a few runs."""
    return min(_once(work) for _ in range(REPEATS))


def peak(family, sampling):
    """Peak memory of making a tenth of the shapes, as a multiple of the bytes returned."""
    tracemalloc.start()
    shapes = data_gen.generate(family, count=COUNT // 10, points=POINTS, sampling=sampling)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most / sum(getattr(shapes, name).nbytes for name in ARRAYS)


def ratios(family, count, timed):
    """Seconds of the slow way for `count` shapes, and of each fast way."""
    rig = data_gen.family(family)
    shapes = rig.vertices(rig.draw(timed, np.random.default_rng(0)))
    slow = seconds(lambda: [by_trimesh(rig, one, seed) for seed, one in enumerate(shapes)]) * count / timed
    fast = {s: seconds(lambda: data_gen.generate(family, count=count, points=POINTS, sampling=s)) for s in AT_LEAST}  # noqa: B023
    return slow, fast


def measure_all():
    """Print the worst three and the median ratio over all linear families."""
    linear = [name for name in data_gen.families() if data_gen.family(name).linear]
    found = {name: ratios(name, COUNT // 10, TIMED // 5) for name in linear}
    print(f"\n{len(linear)} linear families, {COUNT // 10} shapes each, {POINTS} points: times as fast as trimesh")
    for sampling, wanted in AT_LEAST.items():
        ranked = sorted((slow / fast[sampling], name) for name, (slow, fast) in found.items())
        worst = ", ".join(f"{name} {ratio:.1f}" for ratio, name in ranked[:3])
        reached = sum(ratio >= wanted for ratio, _ in ranked)
        median = ranked[len(ranked) // 2][0]
        print(f"{sampling:<8} median {median:.1f}, at least {wanted}: {reached} of {len(ranked)}; lowest {worst}")


def measure(family):
    """Print the table of one family."""
    slow, fast = ratios(family, COUNT, TIMED)
    triangles = len(data_gen.family(family).triangles)
    print(f"\n{COUNT} shapes of {family}, {triangles} triangles, {POINTS} points, best of {REPEATS} runs")
    print(f"{'':<28}{'seconds':>9}{'times as fast':>15}{'at least':>10}{'peak memory':>13}")
    print(f"{f'trimesh ({TIMED} timed, scaled)':<28}{slow:>9.2f}{1:>15.1f}{'':>10}")
    for sampling, wanted in AT_LEAST.items():
        used = peak(family, sampling)
        print(f"{sampling:<28}{fast[sampling]:>9.2f}{slow / fast[sampling]:>15.1f}{wanted:>10}{used:>12.1f}x")


def _once(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


if __name__ == "__main__":
    print(f"{platform.platform()}, {platform.machine()}, 1 thread of {os.cpu_count()}, numpy {np.__version__}")
    if sys.argv[1:] == ["all"]:
        measure_all()
    else:
        for name in sys.argv[1:] or FAMILIES:
            measure(name)
