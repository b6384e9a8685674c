"""Time and memory of a training step against n, the points of a cloud, and against N, the shapes of a collection.

    python tests/benchmarks/scaling.py [THREADS]

Networks of the default widths, k = 32, batch 4, deformations projected onto the handles, both Chamfer terms, chairs of
every family. Against n no point is left out (Config.points = n). Against N a collection of 256 points a shape is a
folder of shards, made for the purpose and read lazily: setting up is all that `train` does before its first step, and
the first STEPS steps count. Each size runs in a process of its own.

Memory is the peak resident one above that after imports, as Linux and macOS tell it. Pages of mapped files that were
read are in it, though the system takes them back when it needs room; Linux tells how many they are, and they stand in
a column of their own. What a training owns grows with the trees it keeps of targets, up to dsn_lite.batches.ROOM.

Time is the shortest of some steps, by the clock and of the processor. The latter, which other programs disturb less and
which leaves out what the system took to hand out memory, is judged. Exit 1 where time or memory an n log n is more than
twice that of a smaller n, or where with N a step, or the memory that a training owns, is more than 1.5 times that of a
smaller N.
"""

import os
import sys
import tempfile
import time
from math import log2
from pathlib import Path

import torch
from apart import alone, machine, peak, shortest

import data_gen
from dsn_lite import Config, load_shapes
from dsn_lite.files import as_shapes
from dsn_lite.training import Training

POINTS, SHAPES, SECONDS = (256, 1024, 4096, 16384, 65536), (100, 1000, 10_000, 100_000), 10
FEW, SMALL, STEPS = 12, 256, 200  # shapes where n grows, points and steps where N grows
SLACK_N_LOG_N, SLACK_FLAT = 2.0, 1.5


def against_points(n, threads):
    """Milliseconds of a step on clouds of n points, by the clock and of the processor, and MB."""
    torch.set_num_threads(threads)
    before = peak()
    training = set_up(as_shapes(data_gen.generate("chair", count=FEW, points=n, seed=0)), n)
    return *shortest(training.take_step, SECONDS, least=6), peak() - before


def against_shapes(folder, threads):
    """Seconds to set up, milliseconds of a step, by the clock and of the processor, MB, and MB of mapped files."""
    torch.set_num_threads(threads)
    before, libraries, start = peak(), mapped(), time.perf_counter()
    training = set_up(load_shapes(folder), SMALL)
    seconds = time.perf_counter() - start
    ms = shortest(training.take_step, 0, least=STEPS)
    files = mapped() - libraries
    return seconds, *ms, peak() - before - files, files


def mapped():
    """MB of mapped files in memory, as Linux tells; elsewhere 0."""
    status = Path("/proc/self/status")
    lines = status.read_text(encoding="utf-8").splitlines() if status.exists() else ()
    return sum(int(line.split()[1]) for line in lines if line.startswith("RssFile")) / 1e3


def set_up(shapes, n):
    """What train() does before its first step."""
    shapes, config = as_shapes(shapes), Config(k=32, batch=4, points=n, symmetry=1, project=True)
    config.check(shapes)
    return Training(shapes, config)


def write(folder, N):
    """N chairs in shards."""
    data_gen.save_shards(data_gen.pieces("chair", count=N, points=SMALL, seed=0), folder)


def points_table(threads):
    """Print the table against n; the names of what grows faster than n log n."""
    relative = f"{'ms an n log n':>16}{'MB an n log n':>16}   (first row = 1)"
    print(f"{'n':>8}{'ms a step':>12}{'of processor':>14}{'MB':>8}{relative}")
    rows = []
    for n in POINTS:
        clock, ms, mb = alone(against_points, n, threads)
        rows.append([value / (n * log2(n)) for value in (ms, mb)])
        relative = [value / first for value, first in zip(rows[-1], rows[0], strict=True)]
        print(f"{n:>8}{clock:>12.1f}{ms:>14.1f}{mb:>8.0f}{relative[0]:>16.2f}{relative[1]:>16.2f}")
    return growing(("time against n", "memory against n"), rows, SLACK_N_LOG_N)


def shapes_table(threads):
    """Print the table against N; the names of what is not flat."""
    print(f"\n{'N':>8}{'s to set up':>14}{'ms a step':>12}{'of processor':>14}{'MB':>8}{'MB of mapped files':>21}")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for N in SHAPES:
            alone(write, Path(folder) / str(N), N)
            seconds, clock, ms, mb, files = alone(against_shapes, Path(folder) / str(N), threads)
            rows.append([ms, mb])
            print(f"{N:>8}{seconds:>14.2f}{clock:>12.1f}{ms:>14.1f}{mb:>8.0f}{files:>21.0f}")
    return growing(("time against N", "memory against N"), rows, SLACK_FLAT)


def growing(names, rows, slack):
    """Which columns have a row that is more than `slack` times the least row before it."""
    columns = zip(names, zip(*rows, strict=True), strict=True)
    return [name for name, c in columns if any(c[i] > slack * min(c[:i]) for i in range(1, len(c)))]


def main(threads):
    """Print both tables; exit 1 where something grows too fast."""
    print(machine(threads))
    missed = points_table(threads) + shapes_table(threads)
    print(f"grows too fast: {', '.join(missed)}" if missed else "no worse than n log n, and flat in N")
    return int(bool(missed))


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else os.cpu_count() or 1))
