"""The language server that all its tests share, since a process takes longer to start than a test to run."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.xabsl.lsp_client import FILES, LspClient


@pytest.fixture(scope="session")
def client() -> Iterator[LspClient]:
    client = LspClient()
    yield client
    client.request("shutdown", {})
    client.notify("exit", {})
    assert client.process.stdin
    client.process.stdin.close()
    client.process.wait(20)
    assert client.process.stdout
    client.process.stdout.close()


@pytest.fixture
def editor(client: LspClient, tmp_path: Path) -> Iterator[LspClient]:
    (tmp_path / "options").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    client.start_session(tmp_path)
    yield client
    client.close_documents()
