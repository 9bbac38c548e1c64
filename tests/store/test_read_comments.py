"""Comments of files: the content they belong to, and merges of comments."""

from vicode.store import CommentedFile, merge_comments

TEXT = """\
# head

vicode: 1
component: A  # name
doc: |
  # no comment
initial: one
states:
  one:
    actions:
      # above
      - call: b
      # below
    transitions:
      - {to: one, when: 'x == "#"'}  # behind
  # last
"""


def shown(text: str) -> list[tuple[str, int, int]]:
    return [(each.text, each.line, each.content_line) for each in CommentedFile(text).comments]


def test_comments_belong_to_the_following_line_unless_it_is_less_indented() -> None:
    expected = [
        ("head", 1, 3),
        ("name", 4, 4),
        ("above", 11, 12),
        ("below", 13, 12),
        ("behind", 15, 15),
        ("last", 16, 9),
    ]
    assert shown(TEXT) == expected
    assert shown(TEXT.replace("\n", "\r\n")) == expected


def test_lines_of_paths() -> None:
    file = CommentedFile(TEXT)
    assert file.line_of(()) == 3
    assert file.line_of(("states", "one", "actions", 0)) == 12
    assert file.line_of(("states", "one", "transitions", 7)) == 14
    assert file.path_at(9) == ("states", "one")
    assert file.path_at(12) == ("states", "one", "actions", 0)
    assert file.block_of(8) == range(8, 16)
    assert file.block_of(10) == range(10, 14)


def test_an_unreadable_file_has_no_paths() -> None:
    file = CommentedFile("vicode: [\n# a\n")
    assert not file.is_readable
    assert file.path_at(1) == ()


def test_added_and_deleted_comments_are_merged() -> None:
    base = "vicode: 1\n# old\ncomponent: A\ninitial: one\nstates:\n  one: {}\n"
    theirs = base.replace("# old\n", "").replace("  one", "  # new\n  one")
    ours = base.replace("states:", "# ours\nstates:").replace("one: {}", "one: {final: true}")
    merged = merge_comments(base, ours, theirs)
    assert merged == ours.replace("# old\n", "").replace("  one", "  # new\n  one")
    assert merge_comments(base, merged, theirs) == merged


def test_comments_are_added_to_a_text_with_conflicts() -> None:
    base = "vicode: 1\ncomponent: A\ninitial: one\nstates:\n  one: {}\n"
    theirs = base.replace("  one", "  # new\n  one")
    marked = f"<<<<<<< ours\n{base}=======\n{base}>>>>>>> theirs\n"
    assert "# new" in merge_comments(base, marked, theirs)
