"""Where joblib starts the tasks of a sweep: in threads of this machine, or on the workers of a Dask cluster."""

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from joblib import parallel_config

PATIENCE = 60  # seconds until a cluster has a worker: some start theirs on demand


@contextmanager
def backend(jobs: int | None, dask: str | None, out: Path) -> Iterator[None]:
    """`jobs` threads, or, where `dask` is the address of a scheduler, its workers.

    Raises ImportError without dask and distributed, ValueError where no scheduler or too few workers answer, or they
    do not see the folder `out`, ConnectionError where the cluster is lost on the way.
    """
    if dask is None:
        with parallel_config(backend="threading", n_jobs=jobs):
            yield
        return
    with _client(dask) as client, parallel_config(backend="dask"):
        _check_workers(client, dask, out)
        try:
            yield
        except CancelledError:
            raise ConnectionError(
                f"sweep: the scheduler at {dask} must stay up until the end, it was lost; start it and its workers "
                "again, and repeat the command: it goes on with what is left"
            ) from None


def _client(address: str) -> Any:
    try:
        from distributed import Client
    except ImportError:
        raise ImportError(
            "sweep: --dask needs the packages dask and distributed, they are not here; install dsn-lite[cluster]"
        ) from None
    try:
        return Client(address, timeout=10)
    except (OSError, ValueError) as trouble:
        raise ValueError(
            f"sweep: a Dask scheduler must answer at {address}, none does ({trouble}); start one with dask scheduler, "
            "and workers with dask worker"
        ) from None


def _check_workers(client: Any, address: str, out: Path) -> None:
    try:
        sees = client.submit(is_there, out, pure=False).result(timeout=PATIENCE)
    except (ImportError, RuntimeError):  # dask: RuntimeError where the scheduler cannot; a worker that cannot dies
        raise ImportError(
            f"sweep: the scheduler at {address} and its workers must be able to import dsn_lite as it is here, they "
            "cannot; install it in their environments"
        ) from None
    except TimeoutError:
        raise ValueError(
            f"sweep: the scheduler at {address} must have workers, none answered; start dask worker {address} where "
            "dsn_lite can be imported"
        ) from None
    if sum(client.nthreads().values()) < 2:
        raise ValueError(
            f"sweep: the workers of {address} must have 2 threads together, they have 1, and joblib would train here; "
            "start another worker, or sweep without --dask on that machine"
        )
    if not sees:
        raise ValueError(f"sweep: workers must see the files and the folder of the runs, {out} is not there; share it")


def is_there(folder: Path) -> bool:
    """Asked of a worker, which must import this package to answer."""
    return folder.is_dir()
