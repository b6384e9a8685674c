"""How fast tables are made: data_gen against building each with trimesh's boxes and sampling its surface.

    python tests/benchmarks/generate.py

One thread, one process. The slow way is timed on a part of the tables and scaled up; the fast ways make them all.
"""

import os

os.environ.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"))

import platform
import time
import tracemalloc

import numpy as np
import trimesh

import data_gen

FAMILY, COUNT, POINTS, TIMED, REPEATS = "table/four_legs", 10_000, 1024, 300, 3
AT_LEAST = {"shared": 30, "fresh": 10}


def by_trimesh(boxes, seed):
    """Points of one table from its boxes (P, 15): a trimesh primitive a part, joined, sampled by area."""
    move = trimesh.transformations.translation_matrix
    parts = [trimesh.creation.box(box[12:], transform=move(box[:3])) for box in boxes]
    points, _ = trimesh.sample.sample_surface(trimesh.util.concatenate(parts), POINTS, seed=seed)
    return points.astype(np.float32)


def seconds(work):
    """The shortest of a few runs."""
    return min(_once(work) for _ in range(REPEATS))


def peak(sampling):
    """Peak memory of making a tenth of the tables, as a multiple of the bytes returned."""
    tracemalloc.start()
    shapes = data_gen.generate(FAMILY, count=COUNT // 10, points=POINTS, sampling=sampling)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    arrays = (shapes.points, shapes.labels, shapes.rest, shapes.boxes, shapes.parameters)
    return most / sum(array.nbytes for array in arrays)


def main():
    """Print the table."""
    rig = data_gen.family(FAMILY)
    boxes = rig.boxes(rig.draw(TIMED, np.random.default_rng(0)))
    slow = seconds(lambda: [by_trimesh(table, seed) for seed, table in enumerate(boxes)]) * COUNT / TIMED
    print(f"{platform.platform()}, {platform.machine()}, 1 thread of {os.cpu_count()}, numpy {np.__version__}")
    print(f"{COUNT} shapes of {FAMILY}, {POINTS} points each, best of {REPEATS} runs")
    print(f"{'':<28}{'seconds':>9}{'times as fast':>15}{'at least':>10}{'peak memory':>13}")
    print(f"{f'trimesh ({TIMED} timed, scaled)':<28}{slow:>9.2f}{1:>15.1f}{'':>10}")
    for sampling, wanted in AT_LEAST.items():
        fast = seconds(lambda: data_gen.generate(FAMILY, count=COUNT, points=POINTS, sampling=sampling))  # noqa: B023
        print(f"{sampling:<28}{fast:>9.2f}{slow / fast:>15.1f}{wanted:>10}{peak(sampling):>12.1f}x")


def _once(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
