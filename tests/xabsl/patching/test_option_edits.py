"""An edit of an option changes the piece that a person would change; comments and layout of the rest stay."""

import pytest

from tests.xabsl.patching.edited_options import edited, version


def replaced(text: str, *pieces: str) -> str:
    """The text with pieces replaced, given as old and new ones in turns."""
    for old, new in zip(pieces[::2], pieces[1::2], strict=True):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


ORIGINAL = """\
/** Plays */
option  play {
    /** How wild */
    float  @wild [0..1]; // of 1

    common  decision  {
        if  (lost) // really
            goto  seek;
    }

    common  action  {
        speed  = 0.5; // slow
    }

    // begins
    //  here
    initial  state  start { // first
        decision  { /** far */  else  if  (x > 5)  goto  seek;  else  stay; }
        action  {
            speed  = 1; // fast
            walk  (walk.speed = 1, walk.turn = 2);
            facing  = left;
        }
    }

    // looks
    target  state  seek  capacity  2 {
        action  { stand ( ) ; }
    }

    state  rest  {
        decision  { else  stay; }
        action  { }
    }
}
"""

# Old and new pieces in turns.
PIECES = {
    "description": ("/** Plays */", "/** Rests */"),
    "description of a parameter": ("/** How wild */", "/** How tame */"),
    "type of a parameter": ("float  @wild", "bool @wild"),
    "added parameter": ("// of 1\n", "// of 1\n    bool @tame;\n"),
    "common decision": ("if  (lost)", "if  (found)"),
    "removed common decision": (
        "    common  decision  {\n        if  (lost) // really\n            goto  seek;\n    }\n\n",
        "",
        "/** far */  else  if",
        "/** far */  if",
        "{ else  stay; }",
        "{ stay; }",
    ),
    "common action": ("speed  = 0.5", "speed  = 0.7"),
    "added common action": ("// slow\n", "// slow\n        stand();\n"),
    "removed common action": ("    common  action  {\n        speed  = 0.5; // slow\n    }\n\n", ""),
    "initial state": ("initial  state  start", "state  start", "target  state  seek", "initial target  state  seek"),
    "target added": ("initial  state  start", "initial  target state  start"),
    "target of a plain state": ("state  rest", "target state  rest"),
    "target removed": ("target  state  seek", "state  seek"),
    "initial becomes target": ("initial  state  start", "target state  start", "state  rest", "initial state  rest"),
    "capacity": ("seek  capacity  2 {", "seek capacity 3 {"),
    "capacity becomes synchronized": ("seek  capacity  2 {", "seek synchronized 2 {"),
    "capacity removed": ("seek  capacity  2 {", "seek {"),
    "capacity added": ("state  rest  {", "state  rest capacity 4  {"),
    "one word above a state": ("//  here", "//  there"),
    "removed comment above a state": ("    // begins\n    //  here\n", ""),
    "added comment above a state": ("    state  rest", "    // ends\n    state  rest"),
    "other comment above a state": ("    // looks\n", "    // is away\n"),
    "guard": ("x > 5", "x > 6"),
    "target of a transition": ("(x > 5)  goto  seek", "(x > 5)  goto  rest"),
    "description before an else": ("/** far */", "/** near */"),
    "leaf": ("{ else  stay; }", "{ else  goto start; }"),
    "removed decision": ("        decision  { else  stay; }\n", ""),
    "removed decision with a description": (
        "        decision  { /** far */  else  if  (x > 5)  goto  seek;  else  stay; }\n",
        "",
    ),
    "added decision": ("2 {\n", "2 {\n        decision {\n            else\n                goto rest;\n        }\n"),
    "symbol": ("facing  = left", "turned = left"),
    "value": ("facing  = left", "facing  = right"),
    "called component": ("walk  (", "run("),
    "argument": ("walk.turn = 2", "walk.turn = 3"),
    "removed argument": ("walk.speed = 1, walk.turn = 2", "walk.turn = 2"),
    "all arguments": ("(walk.speed = 1, walk.turn = 2)", "(walk.up = 3)"),
    "added argument": ("stand ( )", "stand (stand.long = 1)"),
    "call becomes an assignment": ("stand ( ) ;", "speed = 3;"),
    "moved action": (
        "            facing  = left;\n",
        "",
        "            speed  = 1; // fast\n",
        "            facing  = left;\n            speed  = 1; // fast\n",
    ),
    "removed action": ("            speed  = 1; // fast\n", ""),
    "added action": ("            facing  =", "            stand();\n            facing  ="),
    "added action in a line": ("{ stand ( ) ; }", "{ stand ( ) ; speed = 1; }"),
    "added action in an empty block": ("action  { }", "action  {\n            stand();\n        }"),
    "removed only action": ("{ stand ( ) ; }", "{ }"),
    "removed state": (
        "    // looks\n    target  state  seek  capacity  2 {\n        action  { stand ( ) ; }\n    }\n\n",
        "",
    ),
    "added state": (
        "        action  { }\n    }\n",
        (
            "        action  { }\n    }\n\n"
            "    // more\n    state more {\n        action {\n            stand();\n        }\n    }\n"
        ),
    ),
}


def test_without_a_change_each_character_stays() -> None:
    assert edited(ORIGINAL, ORIGINAL) == ORIGINAL


@pytest.mark.parametrize("name", PIECES)
def test_only_the_edited_piece_changes(name: str) -> None:
    expected = replaced(ORIGINAL, *PIECES[name])
    assert edited(ORIGINAL, expected) == expected


def test_the_removed_last_state_leaves_one_line_break() -> None:
    last = "    state  rest  {\n        decision  { else  stay; }\n        action  { }\n    }\n"
    expected = replaced(ORIGINAL, f"\n{last}", "")
    assert edited(ORIGINAL, expected) == expected


def test_an_action_moves_with_its_edits() -> None:
    """Of two assignments to one symbol, the one with more equal words is the old one."""
    old = "option o {\n  initial state s {\n    action {\n      x  = a + b; // 1\n      y  = 2; // 2\n    }\n  }\n}"
    expected = (
        "option o {\n  initial state s {\n    action {\n      y  = 2; // 2\n      x  = a + c; // 1\n    }\n  }\n}"
    )
    assert edited(old, expected) == expected


@pytest.mark.parametrize(
    ("comments", "text"),
    [
        ("", ""),
        ("// a", "a"),
        ("//a\n  // b   c\n", "a b c"),
        ("/// a", "/ a"),
        ("/** d */", ""),
    ],
)
def test_the_comments_above_a_state_are_its_text(comments: str, text: str) -> None:
    found = version(f"option o {{ // not this\n  {comments}\n  initial state s {{ action {{ }} }} }}")
    assert found.doc_of(found.states[0]) == text
