"""Texts of designs with content that the reader does not understand: unknown and duplicate keys, invalid values."""

import re
from collections.abc import Iterator
from random import Random

from hypothesis import strategies as st

from tests.strategies.commented_texts import commented_texts
from vicode.store import read_design
from vicode.store.documents import read_record
from vicode.store.format import DESIGN
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_MARK = re.compile(r"zz\d+q")


def find_marks(text: str) -> list[str]:
    """The marks in the content that was put into a text, each unique."""
    return sorted(_MARK.findall(text))


@st.composite
def strange_texts(draw: st.DrawFn, largest: int = 4) -> str:
    """The text of a random design with content put in that does not change its meaning."""
    text = draw(commented_texts())
    random = Random(draw(st.integers(0, 2**32)))
    meant = read_design(text).design
    for number in range(random.randint(1, largest)):
        changed = _insert(text, f"zz{number}q", random)
        text = changed if read_design(changed).design == meant else text
    return text


def _insert(text: str, mark: str, random: Random) -> str:
    """Insert a pair into a random mapping."""
    _report, root = read_record(text, "", DESIGN)
    assert root is not None
    mapping = random.choice([node for node in _iter_mappings(root.node) if node.pairs])
    key, value = random.choice(mapping.pairs)
    assert isinstance(key, YamlScalar)
    is_unknown = random.random() < 0.4
    name = mark if is_unknown else text[key.start : key.end]
    if mapping.is_flow and is_unknown:
        return f"{text[: mapping.start + 1]}{name}: {mark}, {text[mapping.start + 1 :]}"
    if mapping.is_flow:
        return f"{text[: mapping.end - 1]}, {name}: {mark}{text[mapping.end - 1 :]}"
    indent = " " * (key.start - text.rfind("\n", 0, key.start) - 1)
    if is_unknown:
        return f"{text[: key.start]}{name}: {mark}\n{indent}{text[key.start :]}"
    body = f" {mark}" if random.random() < 0.5 else f"\n{indent}  {mark}: 1"
    end = text.find("\n", max(key.end, value.end)) + 1
    return f"{text[:end]}{indent}{name}:{body}\n{text[end:]}" if end else text


def _iter_mappings(node: YamlNode) -> Iterator[YamlMapping]:
    inner: list[YamlNode] = list(node.items) if isinstance(node, YamlSequence) else []
    if isinstance(node, YamlMapping):
        yield node
        inner = [value for _key, value in node.pairs]
    for child in inner:
        yield from _iter_mappings(child)
