"""Edits of options that stand in one line, have other indentations, or differ from what a generator writes."""

import pytest

from tests.xabsl.patching.edited_options import edited

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
            "option o {\n  initial state s {\n    action { }\n  }\n}",
            "option o { initial state s { decision { stay; } action { } } }",
            "option o { initial state s { action { } } }",
            "option o {\n  initial state s {\n    action { }\n  }\n}",
        ),
        (
            "option o {\n  // a\n  initial state s { action { } }\n}",
            "option o {\n  // b\n  initial state s { action { } }\n}",
            "option o {\n  initial state s { action { } }\n}",
            "option o {\n  // a\n  initial state s { action { } }\n}",
        ),
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
