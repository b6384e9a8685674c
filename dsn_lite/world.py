"""One training in several processes: torchrun --nproc-per-node 2 -m dsn_lite train ...

Every process draws the same batch, takes its share of the pairs and adds its gradients to those of the others, so the
training is that of one process on the same batch.
"""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import torch
import torch.distributed as dist
from torch import Tensor


@dataclass(frozen=True)
class World:
    """This process among all that train together."""

    rank: int = 0
    size: int = 1

    @property
    def writes(self) -> bool:
        """Whether this process writes files and shows progress."""
        return self.rank == 0

    def device(self, device: str) -> str:
        """The device of this process: of several GPUs of a machine, its own."""
        return f"cuda:{os.environ['LOCAL_RANK']}" if self.size > 1 and device == "cuda" else device

    def add(self, tensors: Iterable[Tensor]) -> None:
        """Replaces each tensor by its sum over all processes, in one message."""
        if self.size == 1:
            return
        tensors = list(tensors)
        together = torch.cat([tensor.detach().flatten() for tensor in tensors])
        dist.all_reduce(together)
        for tensor, summed in zip(tensors, together.split([tensor.numel() for tensor in tensors]), strict=True):
            tensor.detach().copy_(summed.view_as(tensor))

    def __post_init__(self) -> None:
        if not 0 <= self.rank < self.size:
            raise ValueError(f"World: rank must be 0 to {self.size - 1}, got {self.rank}; start it with torchrun")


@contextmanager
def joined(device: str) -> Iterator[World]:
    """The world that torchrun tells of in the environment, left at the end; without torchrun a world of one."""
    if "TORCHELASTIC_RUN_ID" not in os.environ:
        yield World()
        return
    dist.init_process_group("nccl" if device.startswith("cuda") else "gloo")
    try:
        yield World(dist.get_rank(), dist.get_world_size())
    finally:
        dist.destroy_process_group()
