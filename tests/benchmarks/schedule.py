"""Which learning-rate schedule fits best in the same number of steps: chosen by this measurement, not by habit.

    python tests/benchmarks/schedule.py [--steps 600] [--seeds 2]

Mixed chairs, held-out shapes, each schedule at three peaks with the same warm-up: constant; halved at four even
intervals, as the authors' code does; falling along half a cosine, which is what Training does.
"""

import argparse
from math import cos, pi

import numpy as np

import data_gen
import dsn_lite
from dsn_lite.config import Config
from dsn_lite.files import as_shapes
from dsn_lite.metrics import evaluate
from dsn_lite.training import WARM_UP, Training

FALLS = {
    "constant": lambda progress: 1.0,
    "halved": lambda progress: 0.5 ** int(4 * min(progress, 0.999)),
    "cosine": lambda progress: (1 + cos(pi * min(1, progress))) / 2,
}
PEAKS = (1e-3, 4e-3, 8e-3)


def scheduled(fall):
    """A Training whose learning rate falls like this."""

    class Scheduled(Training):
        @property
        def learning_rate(self):
            return self.config.learning_rate * min(1, self.progress / WARM_UP + 1e-3) * fall(self.progress)

    return Scheduled


def left_to_fit(fall, chairs, again, config):
    """(CD - floor) / (doing nothing - floor) on hold-out shapes, with the best weights by validation."""
    training = scheduled(fall)(chairs, config)
    for _ in training:
        pass
    training.space.load_state_dict(training.best)
    second = again.split(config.seed)[2]
    return evaluate(training.space.requires_grad_(False), training.test, again=second, pairs=200).fitting_share


def main():
    """Prints the table, the best cell first."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=600)
    parser.add_argument("--seeds", type=int, default=2)
    told = parser.parse_args()
    made = data_gen.generate("chair", count=1000, points=512, seed=0)
    chairs, again = as_shapes(made), as_shapes(data_gen.resample(made, seed=1))
    rows = []
    for name, fall in FALLS.items():
        for peak in PEAKS:
            configs = [Config(k=32, steps=told.steps, learning_rate=peak, seed=seed) for seed in range(told.seeds)]
            shares = [left_to_fit(fall, chairs, again, config) for config in configs]
            rows.append((np.mean(shares), np.std(shares), name, peak))
            print(f"{name:<10} peak {peak:.0e}   left to fit {np.mean(shares):.4f} ± {np.std(shares):.4f}", flush=True)
    print(
        f"best: {min(rows)[2]} from {min(rows)[3]:.0e}; this package: cosine from {dsn_lite.Config().learning_rate:.0e}"
    )


if __name__ == "__main__":
    main()
