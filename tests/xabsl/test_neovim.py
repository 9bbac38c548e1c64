"""The language server in a real editor, on a behavior of 100 options."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.xabsl.neovim import Neovim, start_neovim

OPTIONS, SYMBOLS = 100, 140

SYMBOL_FILE = "\n".join(
    [
        'namespace symbols("Symbols") {',
        "  enum side { left, right };",
        "  enum side input ball.side;",
        "  bool input ball.known;",
        *(f'  float input ball.value{number} "mm";' for number in range(SYMBOLS)),
        *(f"  float input robot.pose{number};" for number in range(SYMBOLS)),
        "  float output motion.speed;",
        "}\n",
    ]
)


def option(number: int) -> str:
    callee = f"option{number + 1}();" if number + 1 < OPTIONS else "motion.speed = 1;"
    return f"""option option{number} {{
  initial state wait {{
    decision {{
      if (ball.known && ball.value{number} < 300)
        goto go;
      else
        stay;
    }}
    action {{
      {callee}
    }}
  }}
  state go {{
    decision {{
      if (robot.pose{number} > 5)
        goto wait;
      else
        stay;
    }}
    action {{
      motion.speed = 2;
    }}
  }}
}}
"""


def write_behavior(folder: Path) -> None:
    (folder / "Options").mkdir()
    includes = [f"Options/option{number}.xabsl" for number in range(OPTIONS)]
    for number, path in enumerate(includes):
        (folder / path).write_text(option(number), encoding="utf-8")
    (folder / "symbols.xabsl").write_text(SYMBOL_FILE, encoding="utf-8")
    lines = [f'include "{path}";' for path in (*includes, "symbols.xabsl")]
    (folder / "agents.xabsl").write_text("\n".join([*lines, 'agent a("A", option0);\n']), encoding="utf-8")


@pytest.fixture(scope="module")
def neovim(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Neovim]:
    folder = tmp_path_factory.mktemp("behavior")
    write_behavior(folder)
    with start_neovim(folder, tmp_path_factory.mktemp("scratch")) as editor:
        editor.open(folder / "Options/option5.xabsl")
        yield editor


def test_completion_in_neovim_inserts_each_dotted_name_once(neovim: Neovim) -> None:
    condition = 4
    neovim.replace_line(condition, "      if (ball.kn")
    assert neovim.complete() == ["ball.known"]
    assert neovim.accept_first() == "if (ball.known"

    neovim.replace_line(condition, "      if (ball.")
    words = neovim.complete()
    assert len(words) == SYMBOLS + 2
    assert all(word.startswith("ball.") for word in words)
    assert neovim.accept_first() == "if (ball.side"

    neovim.replace_line(condition, "      if (robot.pose13")
    assert neovim.complete() == ["robot.pose13", *(f"robot.pose13{number}" for number in range(10))]

    neovim.replace_line(condition, "      if (ball.side == ri")
    assert neovim.complete() == ["right"]
    assert neovim.accept_first() == "if (ball.side == right"


def test_neovim_follows_calls_and_shows_findings(neovim: Neovim) -> None:
    neovim.replace_line(4, "      if (ball.knwn && ball.value5 < 300)")
    neovim.type("<Esc>")
    (message,) = neovim.wait_for(
        "#vim.diagnostic.get(0) == 1 and vim.tbl_map(function(d) return d.message end, vim.diagnostic.get(0))"
    )
    assert message == "unknown symbol ball.knwn; did you mean 'ball.known'?"
    neovim.type(":lua vim.lsp.buf.code_action()<CR>")
    neovim.wait_for("#vim.diagnostic.get(0) == 0")
    assert neovim.evaluate("getline(4)") == "      if (ball.known && ball.value5 < 300)"

    neovim.type("<C-\\><C-n>:10<CR>^")
    neovim.type(":write<CR>:lua vim.lsp.buf.definition()<CR>")
    assert neovim.wait_for("vim.fn.expand('%:t') == 'option6.xabsl' and vim.fn.line('.')") == 1
