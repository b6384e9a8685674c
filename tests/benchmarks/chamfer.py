"""Chamfer distance of 16 pairs of 2048 points with gradient on the CPU: k-d trees against torch.cdist and min.

python tests/benchmarks/chamfer.py [THREADS]
"""

import os
import platform
import sys
import time

import torch

import data_gen
from dsn_lite import chamfer

PAIRS, POINTS, REPEATS, ASKED = 16, 2048, 5, 15


def by_cdist(x, y):
    """The same number from all pairs of distances."""
    distances = torch.cdist(x, y)
    return sum(distances.min(axis).values.square().mean(-1) for axis in (-1, -2))


def step(distance, x, y):
    """One value with its gradient."""
    x = x.clone().requires_grad_()
    distance(x, y).mean().backward()
    return x.grad


def milliseconds(distance, x, y):
    """The shortest of some repeats: what is not the shortest was disturbed."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        step(distance, x, y)
        times.append(1e3 * (time.perf_counter() - start))
    return min(times)


def main(threads):
    """Print the table; exit 1 where the k-d trees are not as fast as asked."""
    torch.set_num_threads(threads)
    clouds = torch.from_numpy(data_gen.generate("table/four_legs", count=2 * PAIRS, points=POINTS).points)
    x, y = clouds[:PAIRS], clouds[PAIRS:]
    torch.testing.assert_close(chamfer(x, y), by_cdist(x, y), rtol=1e-3, atol=1e-6)
    slow, fast = milliseconds(by_cdist, x, y), milliseconds(chamfer, x, y)
    machine = f"{platform.machine()}, {platform.system()}, {os.cpu_count()} cores"
    print(f"{machine}, {threads} torch threads, torch {torch.__version__}")
    print(f"Chamfer of {PAIRS} pairs of {POINTS} points with gradient, shortest of {REPEATS}")
    print(f"{'torch.cdist and min':<22}{slow:9.1f} ms")
    print(f"{'dsn_lite.chamfer':<22}{fast:9.1f} ms  {slow / fast:.1f} times as fast, asked {ASKED}")
    return 0 if slow >= ASKED * fast else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else os.cpu_count() or 1))
