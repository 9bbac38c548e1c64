"""A few people at work at once, as in the benchmark of many: no error, and every edit is there in the end."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from benchmarks.collaboration import measure, started_server

PATIENCE_S = 150


def test_nothing_is_lost_when_many_edit_at_once(tmp_path: Path) -> None:
    with started_server(tmp_path / "said.log") as (url, pid), ThreadPoolExecutor(1) as apart:
        # In a thread: a browser of another test may hold an event loop in this one.
        work = asyncio.wait_for(measure(url, pid, clients=3, seconds=3, forget_s=0), PATIENCE_S)
        result = apart.submit(asyncio.run, work).result()
    assert (result.lost, result.errors) == ([], [])
    assert result.edits > 0
    assert result.seen >= result.edits
    assert "Traceback" not in (tmp_path / "said.log").read_text()
