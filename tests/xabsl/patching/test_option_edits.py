"""An edit of an option changes the piece that a person would change; comments and layout of the rest stay."""

import re

import pytest

from vicode.xabsl import tree
from vicode.xabsl.parser import parse
from vicode.xabsl.patching.option_edits import OptionVersion, edit_option
from vicode.xabsl.patching.source_edits import SourceEdits


def version(text: str) -> OptionVersion:
    parsed = parse(text, "play.xabsl")
    (option,) = parsed.file.body
    assert isinstance(option, tree.OptionNode)
    return OptionVersion(option, parsed, tuple(option.states))


def edited(old: str, after: str, before: str = "") -> str:
    """Edit an option; `before` is the form in which `after` is generated, if it is another one."""
    original = version(old)
    file = SourceEdits(original.file)
    edit_option(file, original.option, version(clean(before or old)), version(clean(after)))
    return file.result()


def clean(text: str) -> str:
    """The text without the comments that no design has: those in and behind lines."""
    return re.sub(r"^( *[^ /\n].*?) *//.*$|/\*(?!\*).*?\*/", r"\1", text, flags=re.MULTILINE)


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


# Old and new text of small options.
SMALL = {
    "common action in a line": (
        "option o { initial state s { action { } } }",
        "option o {\n  common action {\n    x = 1;\n  }\n\n  initial state s { action { } } }",
    ),
    "common action in lines": (
        "option o {\n    initial state s {\n        action { }\n    }\n}",
        "option o {\n    common action {\n        x = 1;\n    }\n\n    initial state s {\n        action { }\n    }\n}",
    ),
    "common action before a blank line": (
        "option o { // c\n\n  initial state s { action { } } }",
        "option o { // c\n  common action {\n    x = 1;\n  }\n\n  initial state s { action { } } }",
    ),
    "common action before a comment": (
        "option o {\n  // c\n  initial state s { action { } } }",
        "option o {\n  common action {\n    x = 1;\n  }\n\n  // c\n  initial state s { action { } } }",
    ),
    "common action before a comment and a blank line": (
        "option o {\n  // c\n\n  initial state s { action { } } }",
        "option o {\n  common action {\n    x = 1;\n  }\n\n  // c\n\n  initial state s { action { } } }",
    ),
    "common action after a parameter": (
        "option o {\n  float @p; // c\n\n  initial state s { action { } } }",
        "option o {\n  float @p; // c\n\n  common action {\n    x = 1;\n  }\n\n  initial state s { action { } } }",
    ),
    "common action after a parameter in a line": (
        "option o { float @p; initial state s { action { } } }",
        "option o { float @p;\n\n  common action {\n    x = 1;\n  }\n\n  initial state s { action { } } }",
    ),
    "common decision before a common action": (
        "option o { common action { } initial state s { decision { stay; } action { } } }",
        (
            "option o {\n  common decision {\n    if (x)\n      goto s;\n  }\n\n"
            "  common action { } initial state s { decision { else stay; } action { } } }"
        ),
    ),
    "common decision before a state": (
        "option o {\n    common action { }\n    initial state s { action { } } }",
        (
            "option o {\n  common decision {\n    if (x)\n      goto s;\n  }\n\n"
            "    common action { }\n    initial state s { action { } } }"
        ),
    ),
    "both": (
        "option o {\n\tinitial state s {\n\t\t action { }\n\t}\n}",
        (
            "option o {\n\tcommon decision {\n\t\t if (x)\n\t\t \t goto s;\n\t}\n\n"
            "\tcommon action {\n\t\t x = 1;\n\t}\n\n\tinitial state s {\n\t\t action { }\n\t}\n}"
        ),
    ),
    "with another indentation than the actions": (
        "option o {\n\t initial state s {\n\t\t action { }\n\t }\n}",
        "option o {\n  common action {\n    x = 1;\n  }\n\n\t initial state s {\n\t\t action { }\n\t }\n}",
    ),
    "with the indentation of the second state": (
        "option o {\n initial state s { action { } }\n    state t {\n        action { }\n    }\n}",
        (
            "option o {\n    common action {\n        x = 1;\n    }\n\n"
            " initial state s { action { } }\n    state t {\n        action { }\n    }\n}"
        ),
    ),
    "with the indentation of a decision": (
        "option o {\n   initial state s {\n      decision { stay; } action { }\n   }\n}",
        (
            "option o {\n   common action {\n      x = 1;\n   }\n\n"
            "   initial state s {\n      decision { stay; } action { }\n   }\n}"
        ),
    ),
    "with the default indentation": (
        "option o { initial state s {\n       action { }\n  }\n}",
        "option o {\n  common action {\n    x = 1;\n  }\n\n  initial state s {\n       action { }\n  }\n}",
    ),
    "common action before a comment in the line": (
        "option o {  /* c */ initial state s { action { } } }",
        "option o {\n  common action {\n    x = 1;\n  }\n\n  /* c */ initial state s { action { } } }",
    ),
    "parameter of an option without parameters": (
        "option  o {\n    initial state s {\n        action { }\n    }\n}",
        "option  o {\n    float @p;\n\n    initial state s {\n        action { }\n    }\n}",
    ),
    "first parameter": (
        "option  o { // c\n    float  @q;\n    initial state s {\n        action { }\n    }\n}",
        "option  o { // c\n    float @p;\n    float  @q;\n    initial state s {\n        action { }\n    }\n}",
    ),
    "comment above a state in a line": (
        "option o { initial state s { action { } } state t { action { } } }",
        "option o { initial state s { action { } }\n  // c\n  state t { action { } } }",
    ),
    "comments above the first state": (
        "option o { initial state s { action { } } }",
        "option o {\n  // c\n  // d\n  initial state s { action { } } }",
    ),
    "comment of a state below a line break": (
        "\noption o {\n initial state s { action { } } }",
        "\noption o {\n  // c\n initial state s { action { } } }",
    ),
    "action with another indentation": (
        "option o {\n  initial state s {\n    action {\n         x  = 1;\n    }\n  }\n}",
        "option o {\n  initial state s {\n    action {\n         x  = 1;\n         y = 2;\n    }\n  }\n}",
    ),
    "argument of a call of a kind": (
        "option o { initial state s { action { f  option  (f.x  = 1) ; } } }",
        "option o { initial state s { action { f  option  (f.x  = 2) ; } } }",
    ),
    "action in several lines": (
        "option o {\n   initial state s {\n      action {\n      }\n   }\n}",
        (
            "option o {\n   initial state s {\n      action {\n"
            f"         walk(\n            walk.{'x' * 60} = 1,\n            walk.{'y' * 60} = 2\n         );\n"
            "      }\n   }\n}"
        ),
    ),
    "state moved to the front": (
        "option o {\n  initial state s { action { } }\n\n  // t\n  state  t { action { } }\n}",
        "option o {\n  // t\n  state  t { action { } }\n\n  initial state s { action { } }\n}",
    ),
    "removed common decision in a line": (
        "option o { common decision { if (x) goto s; } initial state s { decision { else stay; } action { } } }",
        "option o { initial state s { decision { stay; } action { } } }",
    ),
    "state in a line": (
        "option o { initial state s { action { } } }",
        "option o { initial state s { action { } }\n  state t {\n    action {\n    }\n  } }",
    ),
    "state between states without blank lines": (
        "option o {\n  initial state s { action { } }\n  state u { action { } }\n}",
        (
            "option o {\n  initial state s { action { } }\n  state t {\n    action {\n    }\n  }\n"
            "  state u { action { } }\n}"
        ),
    ),
    "state after a single one": (
        "option o {\n  initial state s { action { } }\n}",
        "option o {\n  initial state s { action { } }\n\n  state t {\n    action {\n    }\n  }\n}",
    ),
    "state behind a comment between states": (
        "option o {\n  initial state s { action { } } // c\n  // d\n  state u { action { } }\n}",
        (
            "option o {\n  initial state s { action { } } // c\n  state t {\n    action {\n    }\n  }\n"
            "  // d\n  state u { action { } }\n}"
        ),
    ),
    "first state after a removed common action": (
        "option o {\n  common action { x = 1; }\n  initial state s { action { } }\n}",
        "option o {\n  state t {\n    action {\n    }\n  }\n\n  initial state s { action { } }\n}",
    ),
    "first state after both were removed": (
        (
            "option o {\n  common decision { if (x) goto s; }\n  common action { x = 1; }\n"
            "  initial state s { action { } }\n}"
        ),
        "option o {\n  state t {\n    action {\n    }\n  }\n\n  initial state s { action { } }\n}",
    ),
    "first state after a removed common decision": (
        (
            "option o {\n  common decision { if (x) goto s; }\n  common action { x = 1; }\n"
            "  initial state s { action { } }\n}"
        ),
        (
            "option o {\n  common action { x = 1; }\n  state t {\n    action {\n    }\n  }\n\n"
            "  initial state s { action { } }\n}"
        ),
    ),
    "first state after the only common decision": (
        "option o {\n  common decision { if (x) goto s; }\n  initial state s { action { } }\n}",
        "option o {\n  state t {\n    action {\n    }\n  }\n\n  initial state s { action { } }\n}",
    ),
    "decision in a line": (
        "option o { initial state s { action { } } }",
        "option o { initial state s {\n  decision {\n    stay;\n  }\n  action { } } }",
    ),
    "decision above a comment": (
        "option o {\n  initial state s {\n    // c\n    action { }\n  }\n}",
        "option o {\n  initial state s {\n    decision {\n      stay;\n    }\n    // c\n    action { }\n  }\n}",
    ),
    "decision before a comment in the line": (
        "option o {\n  initial state s {\n    /* c */ action { }\n  }\n}",
        "option o {\n  initial state s {\n    decision {\n      stay;\n    }\n    /* c */ action { }\n  }\n}",
    ),
    "removed flags in one state": (
        "option o { initial  target  state s { action { } } state t { action { } } }",
        "option o { state s { action { } } initial target state t { action { } } }",
    ),
    "one of two flags": (
        "option o { initial  target  state s { action { } } }",
        "option o { initial  state s { action { } } }",
    ),
    "kind of a call": (
        "option o { initial state s { action { f  option  (f.x = 1 ) ; } } }",
        "option o { initial state s { action { f behavior  (f.x = 1 ) ; } } }",
    ),
    "removed kind of a call": (
        "option o { initial state s { action { f  option  ( ) ; } } }",
        "option o { initial state s { action { f  ( ) ; } } }",
    ),
    "added action in a block whose actions share its line": (
        "option o {\n  initial state s {\n    action { x = 1;\n      y = 2; }\n  }\n}",
        "option o {\n  initial state s {\n    action { x = 1;\n      y = 2; z = 3; }\n  }\n}",
    ),
}


@pytest.mark.parametrize("name", SMALL)
def test_a_small_option_is_changed(name: str) -> None:
    old, expected = SMALL[name]
    assert edited(old, expected) == expected


@pytest.mark.parametrize(
    ("old", "before", "after", "expected"),
    [
        # An import drops an empty block of common actions.
        (
            "option o {\n  common action { }\n  initial state s { action { } }\n}",
            "option o { initial state s { action { } } }",
            "option o { common action { x = 1; } initial state s { action { } } }",
            "option o {\n  common action {\n    x = 1;\n  }\n  initial state s { action { } }\n}",
        ),
        # It drops a decision that only stays.
        (
            "option o {\n  initial state s { decision { /* c */ stay; } action { } }\n}",
            "option o { initial state s { action { } } }",
            "option o { initial state s { decision { goto s; } action { } } }",
            "option o {\n  initial state s { decision { /* c */ goto s; } action { } }\n}",
        ),
        (
            "option o {\n  initial state s { decision { stay; } action { } }\n}",
            "option o { initial state s { action { } } }",
            "option o { initial state s { action { x = 1; } } }",
            "option o {\n  initial state s { decision { stay; } action {\n    x = 1;\n  } }\n}",
        ),
        # The words of a comment that is imported in another form.
        (
            "option o {\n  // a\n  /* b */\n  initial state s { action { } }\n}",
            "option o {\n  // b\n  initial state s { action { } }\n}",
            "option o {\n  // c\n  initial state s { action { } }\n}",
            "option o {\n  // a\n  /* c */\n  initial state s { action { } }\n}",
        ),
        (
            "option o {\n  // a\n  initial state s { action { } }\n}",
            "option o {\n  // b\n  initial state s { action { } }\n}",
            "option o {\n  // c\n  // d\n  initial state s { action { } }\n}",
            "option o {\n  // c\n  // d\n  // a\n  initial state s { action { } }\n}",
        ),
        (
            "option o {\n  /* a */ /* b */\n  initial state s { action { } }\n}",
            "option o {\n  // a\n  initial state s { action { } }\n}",
            "option o {\n  // c\n  initial state s { action { } }\n}",
            "option o {\n  /* c */ /* b */\n  initial state s { action { } }\n}",
        ),
        (
            "option o {\n  initial state s { action { }\n    // a\n  }\n  state t { action { } }\n}",
            "option o {\n  initial state s { action { } }\n  // a\n  state t { action { } }\n}",
            "option o {\n  initial state s { action { } }\n  // c\n  state t { action { } }\n}",
            "option o {\n  initial state s { action { }\n    // a\n  }\n  // c\n  state t { action { } }\n}",
        ),
        # What differs stays without an edit.
        (
            "option o {\n  // a\n  initial state s { action { } }\n}",
            "option o {\n  // b\n  initial state s { action { } }\n}",
            "option o {\n  // b\n  initial state s { action { x = 1; } }\n}",
            "option o {\n  // a\n  initial state s { action {\n    x = 1;\n  } }\n}",
        ),
        (
            "/** d */ option o { common decision { if (x) goto s; } initial state s { action { } } }",
            "/** d */ option o { initial state s { action { } } }",
            "/** e */ option o { initial state s { action { } } }",
            "/** e */ option o { common decision { if (x) goto s; } initial state s { action { } } }",
        ),
    ],
)
def test_the_file_may_differ_from_the_version_before(old: str, before: str, after: str, expected: str) -> None:
    assert edited(old, after, before) == expected


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
