"""The process of a simulation ends cleanly."""

import subprocess
import sys
from pathlib import Path

from vicode.simulation import Failed, Setup, decode_response, encode_setup


def test_a_failed_start_is_reported_and_leaves_no_files(tmp_path: Path) -> None:
    folder = tmp_path / "generated"
    folder.mkdir()
    setup = Setup(component="no_such_module:Lamp", probes="no_such_module", path=(), folder=str(folder))
    command = [sys.executable, "-m", "vicode.simulation"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(encode_setup(setup))
        process.stdin.flush()
        answer = decode_response(process.stdout.readline())
        assert process.wait() == 1
    assert isinstance(answer, Failed)
    assert "No module named 'no_such_module'" in answer.message
    assert not folder.exists()
