"""The language server of XABSL: time to complete a name and to publish findings, and how many names it completes.

Run `python -m benchmarks.language_server [AGENTS.xabsl] [--files N]`; the default is a behavior of 100 options. Each
round types a character into an option and asks for completion at once, as editors do. A request that needs no work (a
hover over white space) is the baseline. For accuracy, each name after `goto`, in guards and in calls of N files is
shortened to some characters, and completion must offer the whole name.
"""

import argparse
import random
import re
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import Any

from tests.xabsl.lsp_client import LspClient
from tests.xabsl.test_neovim import write_behavior
from vicode.xabsl.source_loader import load_source
from vicode.xabsl.source_text import read_source
from vicode.xabsl.tokens import KEYWORDS

ROUNDS = 9
TYPED = (1, 3)
_NAME = re.compile(r"(?<![\w@.\"])[A-Za-z_][\w.]{2,}")
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|\"[^\"\n]*\"", re.DOTALL)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("agents", nargs="?", type=Path)
    parser.add_argument("--files", type=int, default=12, help="number of files for accuracy")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if args.agents is None:
            write_behavior(Path(folder))
        agents: Path = args.agents or Path(folder) / "agents.xabsl"
        options = [path for path, parsed in load_source(agents).files.items() if "goto" in parsed.tokens.text]
        client = LspClient()
        try:
            measure_latency(client, options)
            chosen = random.Random(1).sample(options, min(args.files, len(options)))
            for typed in TYPED:
                measure_accuracy(client, chosen, typed)
        finally:
            client.process.kill()


def measure_latency(client: LspClient, options: list[Path]) -> None:
    path = max(options, key=lambda each: each.stat().st_size)
    text = read_source(path).text
    start = text.index("goto ") + len("goto ")
    document = {"uri": path.as_uri()}
    opened = time.perf_counter()
    client.notify(
        "textDocument/didOpen", {"textDocument": {**document, "languageId": "xabsl", "version": 1, "text": text}}
    )
    complete(client, document, text, start)
    print(f"{len(options)} options; open and complete: {1e3 * (time.perf_counter() - opened):.0f} ms")
    white_space = {"textDocument": document, "position": position(text, start - 1)}
    times: dict[str, list[float]] = {"hover over white space": [], "type and complete": [], "complete again": []}
    for version in range(2, 2 + ROUNDS):
        typed = text[:start] + "abcdefghijklmnop"[version - 2] + text[start:]
        times["hover over white space"].append(timed(lambda: client.request("textDocument/hover", white_space)))
        change = {"textDocument": {**document, "version": version}, "contentChanges": [{"text": typed}]}

        def type_and_complete(change: dict[str, Any] = change, typed: str = typed) -> None:
            client.notify("textDocument/didChange", change)
            complete(client, document, typed, start + 1)

        times["type and complete"].append(timed(type_and_complete))
        times["complete again"].append(timed(lambda typed=typed: complete(client, document, typed, start + 1)))
    baseline = median(times["hover over white space"])
    for name, values in times.items():
        print(f"  {name:<24}{1e3 * median(values):8.1f} ms {median(values) / baseline:8.1f} x")
    client.notify("textDocument/didClose", {"textDocument": document})


def measure_accuracy(client: LspClient, options: list[Path], typed: int) -> None:
    """Shorten each name in a document to some characters and look for it among the proposals."""
    found = first = total = 0
    for path in options:
        text, document = read_source(path).text, {"uri": path.as_uri()}
        client.notify(
            "textDocument/didOpen", {"textDocument": {**document, "languageId": "xabsl", "version": 1, "text": text}}
        )
        for version, (start, name) in enumerate(names(text), 2):
            shortened = text[: start + typed] + text[start + len(name) :]
            change = {"textDocument": {**document, "version": version}, "contentChanges": [{"text": shortened}]}
            client.notify("textDocument/didChange", change)
            proposals = complete(client, document, shortened, start + typed)
            labels = [item["label"] for item in proposals if item["label"].startswith(name[:typed])]
            total += 1
            if name not in labels:
                print(path.name, text[:start].count("\n") + 1, name)
            found += name in labels
            first += name in labels[:5]
        client.notify("textDocument/didClose", {"textDocument": document})
    print(f"  {typed} typed: {found} of {total} names offered, {first} among the first five")


def names(text: str) -> Iterator[tuple[int, str]]:
    """The uses of names in a document with their offsets: not their definitions, comments, strings and keywords."""
    code = _COMMENT.sub(lambda match: " " * len(match[0]), text)
    for match in _NAME.finditer(code):
        before = code[: match.start()].rstrip()
        if match[0] not in KEYWORDS and not re.search(r"\b(?:state|option)$", before):
            yield match.start(), match[0]


def complete(client: LspClient, document: dict[str, str], text: str, offset: int) -> list[dict[str, Any]]:
    place = position(text, offset)
    answer: list[dict[str, Any]] = client.request(
        "textDocument/completion", {"textDocument": document, "position": place}
    )
    return answer


def position(text: str, offset: int) -> dict[str, int]:
    line = text.count("\n", 0, offset)
    return {"line": line, "character": offset - (text.rfind("\n", 0, offset) + 1)}


def timed(action: Any) -> float:
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
