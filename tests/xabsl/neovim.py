"""Neovim without a screen, with the language server attached: types keys and reads what an author would see."""

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

_OPTIONS = """
vim.opt.swapfile = false
vim.ui.select = function(items, _, choose) choose(items[1]) end
vim.opt.completeopt = "menuone,noselect"
"""
_PAGE = Path(__file__).parents[2] / "docs/xabsl.md"
_COMMAND = '{ "vicode", "xabsl", "lsp" }'


def _configuration() -> str:
    """What docs/xabsl.md tells users of this version to write."""
    text = _PAGE.read_text(encoding="utf-8").partition("In Neovim 0.7 to 0.10:")[2]
    block = text.partition("```lua\n")[2].partition("```")[0]
    assert _COMMAND in block
    command = ", ".join(json.dumps(part) for part in (sys.executable, "-m", "vicode", "xabsl", "lsp"))
    return _OPTIONS + block.replace(_COMMAND, f"{{ {command} }}")


class Neovim:
    """A running editor, driven through its socket."""

    def __init__(self, program: str, socket: Path) -> None:
        self._command = (program, "--server", str(socket))
        self._value = socket.with_suffix(".json")

    def type(self, keys: str) -> None:
        self._remote("--remote-send", keys)

    def evaluate(self, expression: str) -> Any:
        """The value of a Vimscript expression."""
        # Values that are printed end after 1 KB.
        self._remote("--remote-expr", f"writefile([json_encode({expression})], {_quoted(str(self._value))})")
        return json.loads(self._value.read_text(encoding="utf-8"))

    def lua(self, expression: str) -> Any:
        return self.evaluate(f"luaeval({_quoted(expression)})")

    def wait_for(self, expression: str) -> Any:
        """Wait until an expression of Lua is true, and return its value."""
        for _ in range(200):
            if value := self.lua(expression):
                return value
            time.sleep(0.05)
        messages = self.evaluate("execute('messages')")
        pytest.fail(f"{expression} did not become true; messages: {messages}")

    def open(self, path: Path) -> None:
        self.type(f"<C-\\><C-n>:edit! {path}<CR>")
        self.wait_for("server and vim.lsp.get_client_by_id(server) and vim.lsp.get_client_by_id(server).initialized")

    def replace_line(self, number: int, text: str) -> None:
        """Replace a line by typing it; the cursor stays behind the text, in insert mode."""
        self.type(f"<C-\\><C-n>:{number}<CR>0C{text.replace('<', '<lt>')}")

    def complete(self) -> list[str]:
        """The words that completion offers at the cursor; the menu stays open."""
        self.type("<C-x><C-o>")
        self.wait_for("vim.fn.pumvisible() == 1 or nil")
        return [item["word"] for item in self.evaluate("complete_info(['items']).items")]

    def accept_first(self) -> str:
        """Accept the first offer and return the line."""
        self.type("<C-n><C-y><Esc>")
        line = self.evaluate("getline('.')")
        assert isinstance(line, str)
        return line.strip()

    def _remote(self, option: str, argument: str) -> None:
        subprocess.run([*self._command, option, argument], check=True, capture_output=True, timeout=20)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


@contextmanager
def start_neovim(folder: Path, scratch: Path) -> Iterator[Neovim]:
    """An editor in a folder; without Neovim, the test is skipped."""
    program = shutil.which("nvim")
    if program is None:
        pytest.skip("Neovim is missing: run .ci/neovim, or 'sudo apt install neovim'")
    init, socket = scratch / "init.lua", scratch / "nvim.sock"
    init.write_text(_configuration(), encoding="utf-8")
    editor = subprocess.Popen(
        [program, "--headless", "-u", str(init), "-i", "NONE", "--listen", str(socket)],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        for _ in range(200):
            if socket.exists():
                break
            time.sleep(0.05)
        neovim = Neovim(program, socket)
        yield neovim
        neovim.type("<C-\\><C-n>:qa!<CR>")
        editor.wait(20)
    finally:
        editor.kill()
        editor.wait()
