"""Executes the runs of a sweep on a Dask cluster, whose workers get the project as files."""

import io
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

from distributed import Client, get_worker

from vicode.runs.sweep import Row, Submit, SweepRun, execute

_TIMEOUT_S = 10


@contextmanager
def cluster_runs(address: str, code: Path, project: Path) -> Iterator[Submit]:
    """Execute runs on the workers of a cluster; if a worker ends, its runs are done again.

    Args:
        address: The address of the scheduler.
        code: The folder with the folders of generated code, to which the project is copied.
        project: The folder of the project.

    Raises:
        OSError: There is no scheduler at this address.
    """
    shutil.copytree(project, code / "project", ignore=shutil.ignore_patterns(".*", "__pycache__"))
    with tempfile.TemporaryDirectory() as folder:
        packed = Path(shutil.make_archive(f"{folder}/sweep", "zip", code)).read_bytes()
    with Client(address, timeout=_TIMEOUT_S, set_as_default=False) as client:
        # Unlike scattered data, the result of a task is computed again if the worker that has it ends.
        archive = client.submit(bytes, packed)
        executor = client.get_executor(pure=False)
        try:
            yield lambda run: executor.submit(_execute_packed, run, archive)
        finally:
            executor.shutdown(wait=False)


@lru_cache(maxsize=1)
def _unpack(archive: bytes) -> Path:
    """Unpack the files into the folder of the worker, which Dask removes, also after a crash."""
    folder = tempfile.mkdtemp(dir=get_worker().local_directory)
    with zipfile.ZipFile(io.BytesIO(archive)) as stream:
        stream.extractall(folder)
    return Path(folder)


def _execute_packed(run: SweepRun, archive: bytes) -> Row:
    folder = _unpack(archive)
    return execute(run, folder, folder / "project")
