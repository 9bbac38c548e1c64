"""Decoding and encoding XABSL files: one module does it, and what is not edited keeps its bytes."""

import ast
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.xabsl.lsp_client import FILES, LspClient
from vicode.xabsl.source_text import ENCODINGS, SourceEncodingError, decode_source, encode_source

PACKAGE = Path(__file__).parents[2] / "vicode"
EAST_ASIAN = ("gbk", "big5", "shift_jis", "cp932", "euc_jp", "euc_kr")
CONVERSIONS = {"decode", "encode", "read_text", "write_text", "open"}
# (module, call): why it does not concern the text of XABSL files.
ELSEWHERE = {
    ("xabsl/server/positions.py", "encode"): "columns of the protocol are counted in UTF-16",
    ("services/imported_behavior/import_record.py", "read_text"): "a record in JSON",
    ("services/imported_behavior/import_merge.py", "read_text"): "designs",
    ("services/imported_behavior/updated_files.py", "read_text"): "a record in JSON",
    ("cli/xabsl_diff.py", "read_text"): "a table of inputs",
    ("services/imported_behavior/cpp_sources.py", "decode"): "sources in C++, which are only read",
    ("services/imported_behavior/other_tools.py", "decode"): "files of other tools, which are only read",
    ("importers/bica.py", "decode"): "sources in C++, which are only read",
}
OTHERS = (
    "cli/bridge_behaviors.py",
    "cli/import_command.py",
    "cli/source_encoding.py",
    "cli/xabsl*.py",
    "services/docs/inputs.py",
    "services/imported_behavior/*.py",
    "services/xabsl_encoding.py",
)


def conversions(module: Path) -> set[tuple[str, str]]:
    """The calls in a module that decode or encode text."""
    calls = [node.func for node in ast.walk(ast.parse(module.read_text("utf-8"))) if isinstance(node, ast.Call)]
    names = {call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "") for call in calls}
    return {(module.relative_to(PACKAGE).as_posix(), name) for name in names & CONVERSIONS}


def test_one_module_decodes_and_encodes_the_files() -> None:
    modules = [*(PACKAGE / "xabsl").rglob("*.py"), *(PACKAGE / "importers").glob("*.py")]
    modules += [module for pattern in OTHERS for module in PACKAGE.glob(pattern)]
    found = {each for module in modules if module.name != "source_text.py" for each in conversions(module)}
    assert found == set(ELSEWHERE)
    assert len(conversions(PACKAGE / "xabsl" / "source_text.py")) == 2


@given(st.binary() | st.text().map(str.encode), st.sampled_from(["", *ENCODINGS]))
def test_a_text_that_is_not_edited_keeps_its_bytes(data: bytes, encoding: str) -> None:
    read = decode_source(data, encoding)
    if read.invalid_at is not None:
        assert 0 <= read.invalid_at < len(read.text)
        return
    if encoding in EAST_ASIAN and read.text.encode(read.encoding) != data:
        # Some of their characters have two codes.
        with pytest.raises(SourceEncodingError, match="does not write back"):
            encode_source(read.text, read.encoding, data)
        return
    assert encode_source(read.text, read.encoding, data) == data


@given(st.text(), st.sampled_from(ENCODINGS))
def test_a_text_is_read_as_it_was_written(text: str, encoding: str) -> None:
    try:
        data = text.encode(encoding)
    except UnicodeEncodeError:
        return
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        assert decode_source(data, encoding).text == text


@pytest.mark.parametrize(
    ("text", "encoding", "is_doubtful"),
    [
        ("größte Nähe für Café, „immer“ – schön, naïve Übergröße", "cp1252", False),
        ("crème brûlée, créée, où, Œuvre, «à»", "cp1252", False),
        ("等待", "gbk", True),
        ("ждать", "koi8-r", True),
        ("ждать", "cp1251", True),
        ("ボール", "shift_jis", True),
        ("대기", "euc_kr", True),
        ("等待球", "utf-8", False),
    ],
)
def test_text_of_other_languages_does_not_look_western(text: str, encoding: str, *, is_doubtful: bool) -> None:
    for option in ("", "cp1252", "latin-1"):
        assert (decode_source(text.encode(encoding), option).doubtful_at is not None) == is_doubtful


def test_a_character_that_the_encoding_does_not_have_is_named() -> None:
    with pytest.raises(SourceEncodingError, match="is in Windows-1252, which does not have '球'; replace it"):
        encode_source("球", "cp1252")


def test_the_language_server_reads_the_encoding_of_the_project(editor: LspClient) -> None:
    (editor.folder / "project.yaml").write_text("vicode: 1\nproject: P\nxabsl_encoding: gbk\n", encoding="utf-8")
    symbols = FILES["symbols.xabsl"].replace("distance to the ball", "球的距离")
    (editor.folder / "symbols.xabsl").write_bytes(symbols.encode("gbk"))
    editor.open("options/play.xabsl")
    assert not any(editor.diagnostics.values())
    hover = editor.request(
        "textDocument/hover", editor.at("options/play.xabsl", FILES["options/play.xabsl"], "ball.distance")
    )
    assert "球的距离" in hover["contents"]["value"]
