"""Texts from elsewhere cannot command the terminal: what is printed has no control characters and no forged lines."""

import contextlib
import io
import json
import unicodedata
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cli.command_runner import lamps, vicode
from tests.cli.test_attach_command import blinking
from vicode.bica.errors import print_error
from vicode.cli.bridge_view import PlainBridgeView
from vicode.findings import Finding, Note, SourceLocation, get_rule, render_text

__all__ = ["lamps"]

HOSTILE = "\x1b[31m\x1b]0;title\x07\r\x9b2J\u202e\nforged"
texts = st.text() | st.text(st.sampled_from("ab\x1b\n\r\x07\x9b\u202e\u2028\x00\ud800"))


def is_harmless(printed: str) -> bool:
    return not any(unicodedata.category(char) in ("Cc", "Cf", "Cs", "Zl", "Zp") for char in printed.replace("\n", ""))


@given(text=texts)
def test_a_message_of_the_runtime_is_one_line(text: str) -> None:
    with contextlib.redirect_stderr(io.StringIO()) as printed:
        print_error(text, kind="control")
    assert printed.getvalue().count("\n") == 1
    assert printed.getvalue().startswith("control: ")
    assert is_harmless(printed.getvalue())


@given(message=texts, file=texts)
def test_a_finding_has_one_line(message: str, file: str) -> None:
    place = SourceLocation(file=file, line=1, column=1, length=1)
    note = Note(message=message, location=place)
    finding = Finding(rule=get_rule("D402"), message=message, fix=message, location=place, notes=(note,))
    printed = render_text([finding])
    assert printed.count("\n") == 2
    assert is_harmless(printed)


def test_printable_texts_stay_as_they_are(capsys: pytest.CaptureFixture[str]) -> None:
    print_error("Größe → 「箱」 'x' \\n")
    assert capsys.readouterr().err == "error: Größe → 「箱」 'x' \\n\n"


def test_names_in_designs_do_not_command_the_terminal(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    name = json.dumps(HOSTILE)
    (lamps / "lamp.yaml").write_text(
        f"vicode: 1\ncomponent: Lamp\ninitial: {name}\nstates: {{{name}: {{}}, B: {{}}}}\n"
    )
    assert vicode("check", "lamps") == 1
    assert vicode("check", f"lamps/{HOSTILE}") == 2
    out, err = capsys.readouterr()
    assert "forged" in out
    assert "forged" in err
    assert is_harmless(out + err)
    assert not any(line.startswith("forged") for line in (out + err).splitlines())


def test_robots_do_not_command_the_terminal_of_a_viewer(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with blinking(30) as server:
        server._feeds[0].name = HOSTILE
        assert vicode("attach", server.address, "--token", server.token, "--print") == 1
    out, err = capsys.readouterr()
    assert "\\x1b[31m" in err
    assert is_harmless(out + err)


def test_states_of_a_trace_do_not_command_the_terminal(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "lamps/lamp.yaml", "--seconds", "1", "--trace", "one") == 0
    hostile = json.dumps(HOSTILE)[1:-1]
    Path("two").write_text(Path("one").read_text().replace("Lit", hostile).replace('"Lamp"', f'"{hostile}"'))
    capsys.readouterr()
    assert vicode("trace", "stats", "two") == 0
    assert vicode("trace", "diff", "one", "two") == 1
    out = capsys.readouterr().out
    assert "forged" in out
    assert is_harmless(out)


def test_events_of_a_bridge_do_not_command_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    class Server:
        def on_event(self, _robot: str, _text: str) -> None:
            """Replaced by the view."""

    server = Server()
    PlainBridgeView(server)  # type: ignore[arg-type]
    server.on_event("rosa", HOSTILE)
    printed = capsys.readouterr().out
    assert printed.count("\n") == 1
    assert is_harmless(printed)
