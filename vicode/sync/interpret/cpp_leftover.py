"""Writes what was not understood: the generated source with the functions of the edited file that differ."""

from collections.abc import Collection, Sequence

from vicode.sync.interpret.cpp_comparison import CppFile


def write_cpp_leftover(own_file: CppFile, edited_file: CppFile, different: Collection[str]) -> str:
    """Return the generated text with some functions, and everything outside functions, of the edited file."""
    own, other = own_file.items, edited_file.items
    generated, edited = own_file.text, edited_file.text
    if not different and own_file.others() == edited_file.others():
        return generated
    texts = {item.name: edited[item.start : item.end] for item in other if item.name in different}
    if own_file.others() == edited_file.others():
        parts = [
            (item.name, texts.pop(item.name, "") if item.name in different else generated[item.start : item.end])
            for item in own
        ]
        tail = generated[own[-1].end :] if own else generated
    else:
        generated_texts = {item.name: generated[item.start : item.end] for item in own if item.name}
        parts = [
            (item.name, generated_texts.pop(item.name, edited[item.start : item.end]))
            if item.name not in different
            else (item.name, texts.pop(item.name))
            for item in other
        ]
        texts |= {name: text for name, text in generated_texts.items() if name not in different}
        tail = edited[other[-1].end :] if other else edited
    for name, text in texts.items():
        _insert(parts, name, text, [item.name for item in (*other, *own)])
    return "".join(text for _name, text in parts) + tail


def _insert(parts: list[tuple[str, str]], name: str, text: str, order: Sequence[str]) -> None:
    """Insert a function behind the one that it stands behind in its file."""
    before = [each for each in order[: order.index(name)] if each]
    names = [each for each, _text in parts]
    places = [names.index(each) for each in before if each in names]
    at = max(places) + 1 if places else next((at for at, each in enumerate(names) if each), len(names))
    parts.insert(at, (name, text))
