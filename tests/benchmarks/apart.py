"""What benchmarks of time and memory share: work in a process of its own, and what it took there."""

import os
import platform
import resource
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import torch


def alone(work, *arguments):
    """The result of some work in a fresh process, which shares no memory with this one."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return pool.submit(work, *arguments).result()


def peak():
    """Peak resident memory of this process so far, in MB. Linux and macOS tell it, each in its own unit."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)


def shortest(work, seconds, least=3):
    """Milliseconds of the shortest run, by the clock and of the processor without the system's share, over some time.

    What is not the shortest was disturbed. The first runs, `least` among them, may be slower: they claim memory.
    """
    start, clock, processor = time.perf_counter(), [], []
    while len(clock) < least or time.perf_counter() - start < seconds:
        before = time.perf_counter(), _processor()
        work()
        clock.append(time.perf_counter() - before[0])
        processor.append(_processor() - before[1])
    return 1e3 * min(clock), 1e3 * min(processor)


def machine(threads):
    """One line on what the figures were measured on."""
    cores = f"{os.cpu_count()} cores, {threads} torch threads"
    return f"{platform.machine()}, {platform.system()}, {cores}, torch {torch.__version__}"


def _processor():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime
