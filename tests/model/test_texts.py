"""iter_texts finds all texts; rewrite_text replaces each of them."""

from hypothesis import given

from tests.strategies.designs import designs
from vicode.model.design import Design
from vicode.model.texts import iter_texts, rewrite_text


@given(designs)
def test_each_text_can_be_replaced(design: Design) -> None:
    before = [(each.path, each.text) for each in iter_texts(design)]
    for path, text in before:
        changed = rewrite_text(design, path, lambda old: f"{old}~")
        after = [(each.path, each.text) for each in iter_texts(changed)]
        assert after == [(at, f"{old}~" if at == path else old) for at, old in before], path
        assert rewrite_text(changed, path, lambda _new, old=text: old) == design


@given(designs)
def test_an_unknown_path_changes_nothing(design: Design) -> None:
    for path in (("states", "nowhere", "doc"), ("common", "transitions", 99, "when"), ("module", "klingon"), ("x", 0)):
        assert rewrite_text(design, path, lambda _old: "new") == design
