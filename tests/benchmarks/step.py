"""One training step at the authors' widths, against the same step written down literally (literal.py beside this file).

    python tests/benchmarks/step.py [THREADS]        the table; exit 1 where a goal is missed
    python tests/benchmarks/step.py [THREADS] --profile        where the time of our step goes

16 pairs of 2048 points, k = 64, deformations projected onto the handles, both Chamfer terms, gradient and Adam, all on
chairs of every family. "16 pairs" are of 32 different shapes; "within itself" are 16 shapes, each a source and a target
once, as in a training here: each is encoded once, while the literal step runs its 16 pairs all the same. Kept from step
to step are the trees of targets (ours) and B and B+ (literal).

Each number is measured in a process of its own: the shortest of as many steps as fit into SECONDS (three at least), the
same step counted in processor time, so without what the system took to hand out fresh memory, and the peak resident
memory above that after imports, which Linux and macOS tell. Other programs on the same cores spoil the clock.

Where the time goes, on one thread with AVX-512 (--profile). Within itself: backward 53 %, F 31 %, E 10 %, both Chamfer
terms 5 %, handles 1 %, Adam less. Matrix products are two thirds of it, at the speed of the processor: a fifth is the
layer from 128 to 1024 before the maximum, forward only, since its backward reads the winning points alone; most of the
rest is F's head on every point. Then come copies (6 %) and the gradient of LeakyReLU (5 %).
The literal step takes half its time in batched products, to form B B+ and to multiply by its transpose in the backward
pass, a fifth in convolutions, and, on a machine that is slow to hand out memory, as long again for 6 GB of fresh pages:
the ratio of processor times is without those.
"""

import argparse
import os
import sys

import torch
from apart import alone, machine, peak, shortest
from literal import Theirs, paired
from torch.profiler import profile, record_function

import data_gen
from dsn_lite import Shapes, losses
from dsn_lite.batches import crowded
from dsn_lite.chamfer import plant
from dsn_lite.dictionary import offsets
from dsn_lite.files import as_shapes
from dsn_lite.handles import BatchHandles
from dsn_lite.networks import DictionaryPredictor, Encoder

PAIRS, POINTS, K, SECONDS = 16, 2048, 64, 30
WIDTHS = (64, 64, 64, 128, 1024)
ROWS = {"16 pairs": (2 * PAIRS, 6), "within itself": (PAIRS, 8)}  # shapes, and how many times as fast
STAGES = ("E", "F", "handles", "Chamfer terms", "backward", "Adam")
UNITS = ("ms", "ms of processor", "MB")
SHARE = 5  # the literal step's memory over ours, at least


class Ours(torch.nn.Module):
    """The networks and loss of dsn_lite at the authors' widths, for the same pairs."""

    def __init__(self, shapes: Shapes, pairs: int, k: int):
        super().__init__()
        self.encode = Encoder(k, WIDTHS, (512, 256))
        self.dictionary = DictionaryPredictor(k, WIDTHS[:2], WIDTHS[2:], (512, 256, 128), columns="unit")
        self.points, self.pairs, self.rest = shapes.points, pairs, shapes.rest[:pairs]
        self.labels, self.boxes = crowded(shapes.labels[:pairs], shapes.boxes[:pairs])
        self.trees = [plant(cloud)[0] for cloud in paired(shapes.points, pairs)[1]]

    def forward(self):
        """100 (L_F + L_R) of the pairs; each shape is encoded once."""
        x, y = paired(self.points, self.pairs)
        with record_function("E"):
            of_x, of_y = paired(self.encode(self.points), self.pairs)
        with record_function("F"):
            fields, scales = self.dictionary.unscaled(x)
            moved = offsets(fields, (of_y - of_x) / scales.flatten(1))
        with record_function("handles"):
            deformed = x + BatchHandles(self.labels, self.rest, self.boxes).project(moved)
        with record_function("Chamfer terms"):
            own = plant(deformed)
            terms = losses.fitting(deformed, y, self.trees, own) + losses.symmetry(deformed, own=own)
        return losses.FACTOR * terms


def chairs(count, points=POINTS, dtype="float32"):
    """Chairs of every family."""
    return as_shapes(data_gen.generate("chair", count=count, points=points, seed=0, dtype=dtype))


def step(model, optimizer):
    """One step of Adam."""
    optimizer.zero_grad()
    loss = model()
    with record_function("backward"):
        loss.backward()
    with record_function("Adam"):
        optimizer.step()


def measure(kind, count, threads):
    """Milliseconds of a step by the clock and of the processor, and MB above those after imports."""
    torch.set_num_threads(threads)
    before, model = peak(), kind(chairs(count), PAIRS, K)
    optimizer = torch.optim.Adam(model.parameters(), lr=1e-3)
    return *shortest(lambda: step(model, optimizer), SECONDS), peak() - before


def check_same(threads):
    """Asserts that both are one function where batch norm and what the two networks word otherwise is taken out."""
    torch.set_num_threads(threads)
    torch.manual_seed(0)
    shapes = chairs(6, points=256, dtype="float64")
    for pairs in (3, 6):
        ours, theirs = Ours(shapes, pairs, K).double(), Theirs(shapes, pairs, K, torch.nn.Identity).double().eval()
        theirs.take(ours.encode, ours.dictionary)
        values = ours(), theirs()
        torch.testing.assert_close(*values)
        for value in values:
            value.backward()
        for name in ("encode", "dictionary"):
            first = getattr(ours, name), getattr(theirs, name)
            gradients = [next(net.parameters()).grad.flatten() for net in first]
            torch.testing.assert_close(*gradients)


def table(threads):
    """Print the table; exit status 1 where a goal is missed."""
    alone(check_same, threads)
    print(f"{machine(threads)}; both steps are one function but for batch norm")
    print(f"a step on {PAIRS} pairs of {POINTS} points, k = {K}; peak memory after imports")
    print(f"{'':<32}{'literal':>9}{'dsn_lite':>10}{'ratio':>7}{'goal':>6}")
    missed = False
    for row, (count, goal) in ROWS.items():
        found = [alone(measure, kind, count, threads) for kind in (Theirs, Ours)]
        for unit, theirs, ours, wanted in zip(UNITS, *found, (goal, None, SHARE), strict=True):
            print(f"{f'{row}, {unit}':<32}{theirs:>9.0f}{ours:>10.0f}{theirs / ours:>7.1f}{wanted or '':>6}")
            missed |= wanted is not None and theirs < wanted * ours
    return int(missed)


def show_profile(threads):
    """Print where the time of a step goes: its stages, then the operations that take most."""
    torch.set_num_threads(threads)
    for row, kind, count in (*((row, Ours, count) for row, (count, _) in ROWS.items()), ("literal", Theirs, 2 * PAIRS)):
        model = kind(chairs(count), PAIRS, K)
        optimizer = torch.optim.Adam(model.parameters(), lr=1e-3)
        step(model, optimizer)
        with profile() as seen:
            step(model, optimizer)
        events = seen.key_averages()
        whole = sum(event.self_cpu_time_total for event in events)
        stages = {event.key: event.cpu_time_total for event in events if event.key in STAGES}
        most = sorted(events, key=lambda event: -event.self_cpu_time_total)[:12]
        for title, shares in (("stages", stages), ("operations", {e.key: e.self_cpu_time_total for e in most})):
            print(f"{row}, {title}: " + ", ".join(f"{key} {time / whole:.0%}" for key, time in shares.items()))
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("threads", nargs="?", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--profile", action="store_true")
    arguments = parser.parse_args()
    sys.exit((show_profile if arguments.profile else table)(arguments.threads))
