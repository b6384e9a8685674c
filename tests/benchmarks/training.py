"""What 120 seconds of training reach on the procedural table, over seeds, beside doing nothing and no training.

    python tests/benchmarks/training.py [--seconds 120] [--seeds 3]

2000 shapes of table/four_legs, 512 fresh points each, split 85-5-10. The seed draws the weights, the split and the
batches; the shapes are the same. Measured on hold-out shapes only: fitting and parallelogram as Chamfer distances in
units of the sampling floor, transfer as squared distance to the true transfer in units of leaving the shape alone.
"""

import argparse
import platform

import numpy as np
import torch

import data_gen
import dsn_lite
from dsn_lite.config import network
from dsn_lite.data import Frame
from dsn_lite.files import as_shapes
from dsn_lite.metrics import Evaluation, evaluate

COLUMNS = ("fitting", "parallelogram", "identity", "moved", "transfer")


def numbers(result: Evaluation) -> tuple[float, ...]:
    """One row of the table: CDs over the floor, identity residual, rms of z (+) xy - z, transfer error."""
    fitting, parallelogram = result.fitting_cd / result.floor, result.parallelogram_cd / result.floor
    return fitting, parallelogram, result.identity, result.moved, result.transfer_error


def run(tables: data_gen.Collection, again: dsn_lite.Shapes, config: dsn_lite.Config) -> dict[str, tuple[float, ...]]:
    """Trains once and measures the space and its baselines on the hold-out shapes."""
    records = []
    space = dsn_lite.train(tables, config, watch=lambda training, record: records.append(record))
    test, second = as_shapes(tables).split(config.seed)[2], again.split(config.seed)[2]
    spaces = {"trained": space, "untrained": network(config, Frame.of(test)), "do nothing": dsn_lite.DoNothing()}
    results = {name: evaluate(each, test, again=second) for name, each in spaces.items()}
    whole = results["trained"]
    exactly = f"true deformation scores {whole.exact_cd / whole.floor:.3f} x floor"
    print(f"seed {config.seed}: {records[-1].step} steps; floor {whole.floor:.3e}; {exactly}")
    return {name: numbers(result) for name, result in results.items()}


def main() -> None:
    """Prints one line a seed and the table of means and spreads."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--seeds", type=int, default=3)
    arguments = parser.parse_args()
    print(f"{platform.machine()} {platform.system()}, {torch.get_num_threads()} threads, torch {torch.__version__}")
    tables = data_gen.generate("table/four_legs", count=2000, points=512, seed=0)
    again = as_shapes(data_gen.resample(tables, seed=1))
    runs = [
        run(tables, again, dsn_lite.Config(seconds=arguments.seconds, seed=seed)) for seed in range(arguments.seeds)
    ]
    print(f"{'':<12}" + "".join(f"{column:>22}" for column in COLUMNS))
    for name in runs[0]:
        values = np.array([each[name] for each in runs])
        cells = [f"{mean:.3g} ± {spread:.2g}" for mean, spread in zip(values.mean(0), values.std(0), strict=True)]
        print(f"{name:<12}" + "".join(f"{cell:>22}" for cell in cells))


if __name__ == "__main__":
    main()
