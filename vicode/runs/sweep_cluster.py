"""Executes the runs of a sweep on a Dask cluster, whose workers get the project as files."""

import io
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

from distributed import Client

from vicode.runs.sweep import Row, Submit, SweepRun, execute


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
    with Client(address, set_as_default=False) as client:
        # Unlike scattered data, the result of a task is computed again if the worker that has it ends.
        archive = client.submit(bytes, packed)
        executor = client.get_executor(pure=False)
        try:
            yield lambda run: executor.submit(_execute_packed, run, archive)
        finally:
            executor.shutdown(wait=False)


@lru_cache(maxsize=1)
def _unpack(archive: bytes) -> "tempfile.TemporaryDirectory[str]":
    """Unpack the files; the folder is removed after the last run that uses it."""
    folder = tempfile.TemporaryDirectory(prefix="vicode-sweep-", suffix=".tmp")
    with zipfile.ZipFile(io.BytesIO(archive)) as stream:
        stream.extractall(folder.name)
    return folder


def _execute_packed(run: SweepRun, archive: bytes) -> Row:
    folder = _unpack(archive)
    return execute(run, Path(folder.name), Path(folder.name, "project"))
