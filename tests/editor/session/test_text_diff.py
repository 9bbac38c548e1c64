"""Side-by-side diffs contain both texts, except long unchanged parts."""

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session.text_diff import LineStatus, side_by_side

lines = st.lists(st.sampled_from("abcde"), max_size=12)


def test_a_changed_line_is_next_to_its_new_text() -> None:
    old, new = "\n".join("abcdefghij"), "\n".join("abcdXfghij")
    rows = side_by_side(old, new, context=1)
    assert [(row.status, row.old, row.new) for row in rows] == [
        (LineStatus.GAP, "3 unchanged lines", ""),
        (LineStatus.SAME, "d", "d"),
        (LineStatus.CHANGED, "e", "X"),
        (LineStatus.SAME, "f", "f"),
        (LineStatus.GAP, "4 unchanged lines", ""),
    ]
    assert (rows[2].old_number, rows[2].new_number) == (5, 5)


def test_equal_texts_have_no_rows_and_new_files_only_added_ones() -> None:
    assert side_by_side("a\nb", "a\nb") == ()
    assert {row.status for row in side_by_side("", "a\nb")} == {LineStatus.ADDED}
    assert {row.status for row in side_by_side("a\nb", "")} == {LineStatus.REMOVED}


@given(lines, lines)
def test_both_texts_can_be_read_back(olds: list[str], news: list[str]) -> None:
    rows = side_by_side("\n".join(olds), "\n".join(news), context=99)
    if olds != news:
        assert [row.old for row in rows if row.old_number] == olds
        assert [row.new for row in rows if row.new_number] == news
