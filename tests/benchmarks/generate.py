"""How fast shapes are made: data_gen against building each with trimesh, part by part, and sampling its surface.

    python tests/benchmarks/generate.py [FAMILY ...]        by default a table of boxes, and the slowest linear family

One thread, one process. The slow way is timed on a part of the shapes and scaled up; the fast ways make them all.
trimesh is given the vertices of all parts for nothing; it only builds the meshes, joins them and samples.
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

FAMILIES, COUNT, POINTS, TIMED, REPEATS = ("table/four_legs",), 10_000, 1024, 200, 3
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


def slowest():
    """The linear family of the most triangles."""
    return max((rig for rig in map(data_gen.family, data_gen.families()) if rig.linear), key=_triangles).name


def measure(family):
    """Print the table of one family."""
    rig = data_gen.family(family)
    shapes = rig.vertices(rig.draw(TIMED, np.random.default_rng(0)))
    slow = seconds(lambda: [by_trimesh(rig, one, seed) for seed, one in enumerate(shapes)]) * COUNT / TIMED
    print(f"\n{COUNT} shapes of {family}, {len(rig.triangles)} triangles, {POINTS} points, best of {REPEATS} runs")
    print(f"{'':<28}{'seconds':>9}{'times as fast':>15}{'at least':>10}{'peak memory':>13}")
    print(f"{f'trimesh ({TIMED} timed, scaled)':<28}{slow:>9.2f}{1:>15.1f}{'':>10}")
    for sampling, wanted in AT_LEAST.items():
        fast = seconds(lambda: data_gen.generate(family, count=COUNT, points=POINTS, sampling=sampling))  # noqa: B023
        used = peak(family, sampling)
        print(f"{sampling:<28}{fast:>9.2f}{slow / fast:>15.1f}{wanted:>10}{used:>12.1f}x")


def _triangles(rig):
    return len(rig.triangles)


def _once(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


if __name__ == "__main__":
    print(f"{platform.platform()}, {platform.machine()}, 1 thread of {os.cpu_count()}, numpy {np.__version__}")
    for name in sys.argv[1:] or (*FAMILIES, slowest()):
        measure(name)
