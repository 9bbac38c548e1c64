"""An edit of a program changes its files as a person would: each case is the original with a piece replaced by hand."""

import re

import pytest

from tests.xabsl.xabsl_cases import load_texts
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.patching.program_patch import ProgramVersion, patch_program
from vicode.xabsl.printer import print_file

ORIGINAL = """\
/* by hand */
include "known.xabsl";
include "does.xabsl";
include "play.xabsl";
include "rest.xabsl";

/** A player */
agent player ( "Player" , play ) ;
=== known.xabsl
/** What is known */
namespace known ( "Known" ) {
    /** Where the ball is */
    float input ball.x [-10..10] "mm"; // in front
    bool input ball.seen;
    /** How sure */
    float input ball.sure(
        /** Age in
            seconds */
        float ball.sure.age [0..5] "s"; // from then
        bool ball.sure.all;
    );

    // numbers
    const limit = -3.5 "mm"; // measured
    const plain = 2;

    enum side { left, right, none };
    enum internal_side internal {
        near,
        far, // away
        gone
    };
    float output speed [0..1] "m/s";
    enum side output facing;
}
=== does.xabsl
namespace does ( "Does" ) {
    /** Walks */
    behavior walk {
        /** How fast */
        float walk.speed [0..1] "m/s"; // forwards
        float walk.turn;
    }
    behavior stand { }
}
=== play.xabsl
/** Plays */
option play {
    /** How wild */
    float @wild [0..1]; // of 1

    common decision {
        /** lost */
        if (!ball.seen) // really
            goto seek;
    }
    common action {
        speed = 0.5; // slow
    }

    // begins here
    initial state start {
        decision {
            // is far
            else if (ball.x > 5) {
                goto seek;
            } else if (ball.x > 4) { // rather near
                stay;
            } else if (ball.x > 3)
                goto done;
            else {
                stay;
            }
        }
        action {
            // go
            walk(walk.speed = 0.5, walk.turn = 1); // on
            facing = left;
            stand();
        }
    }

    // looks around
    state seek {
        decision {
            else stay;
        }
        action { }
    }

    // in reserve
    state spare {
        action { }
    }

    target state done {
        decision { else if (@wild > 0.5) goto start; else stay; }
        action { speed = 1; }
    }
}
=== rest.xabsl
option rest { initial state only { action { stand(); } } }
"""


def split(text: str) -> dict[str, str]:
    """The files of a program, which begin with a line with three equals signs and the name."""
    parts = re.split(r"^=== (.*)\n", text, flags=re.MULTILINE)
    return {"agents.xabsl": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def clean(text: str) -> dict[str, str]:
    """The files in the layout of the printer, without comments but those above states; descriptions stay."""
    plain = split(re.sub(r"//.*$(?!\n *(initial |target )?state )|/\*(?!\*)(?s:.*?)\*/", "", text, flags=re.MULTILINE))
    return {path.name: print_file(parsed.file) for path, parsed in load_texts(plain).files.items()}


def version(files: dict[str, str]) -> ProgramVersion:
    source = load_texts(files)
    compiled = compile_source(source)
    assert compiled.program is not None, [finding.message for finding in compiled.findings]
    return ProgramVersion(source, compiled)


def patched(original: dict[str, str], before: dict[str, str], after: dict[str, str]) -> dict[str, str | None]:
    changed = patch_program(version(original), version(before), version(after))
    return original | {path.name: text for path, text in changed.items()}


CASES: dict[str, tuple[str, ...]] = {
    "description of an agent": ("/** A player */", "/** A good player */"),
    "removed description of an agent": ("/** A player */\n", ""),
    "title of an agent": ('"Player"', '"The player"'),
    "root of an agent": (", play )", ", rest )"),
    "removed description of a namespace": ("/** What is known */\n", ""),
    "removed description of a symbol": ("    /** Where the ball is */\n", ""),
    "added description of a symbol": ("    bool input ball.seen", "    /** Whether */\n    bool input ball.seen"),
    "one word of a description": ("Where the ball is", "Where the foot is"),
    "removed description of a parameter of a symbol": ("        /** Age in\n            seconds */\n", ""),
    "one word of a description of two lines": ("Age in\n            seconds", "Time in\n            seconds"),
    "removed description of a basic behavior": ("    /** Walks */\n", ""),
    "added description of a basic behavior": ("    behavior stand", "    /** Stands */\n    behavior stand"),
    "removed description of a parameter": ("        /** How fast */\n", ""),
    "added description of a parameter": ("        float walk.turn", "        /** How far */\n        float walk.turn"),
    "removed description of an option": ("/** Plays */\n", ""),
    "added description of an option": ("option rest", "/** Rests */\noption rest"),
    "removed description of a parameter of an option": ("    /** How wild */\n", ""),
    "range of a symbol": ("[-10..10]", "[-20..20]"),
    "unit of a symbol": ('[-10..10] "mm"', '[-10..10] "cm"'),
    "removed unit of a symbol": ('[-10..10] "mm"', "[-10..10]"),
    "direction of a symbol": ("bool input ball.seen", "bool internal ball.seen"),
    "type of a symbol with parameters": ("float input ball.sure", "bool input ball.sure"),
    "range of a parameter of a symbol": ('[0..5] "s"', '[0..6] "s"'),
    "removed parameter of a symbol": ("        bool ball.sure.all;\n", ""),
    "added parameter of a symbol": ("ball.sure.all;\n", "ball.sure.all;\n        float ball.sure.more;\n"),
    "number of a constant": ("-3.5", "7"),
    "negative number of a constant": ("plain = 2", "plain = -2"),
    "unit of a constant": ('-3.5 "mm"', '-3.5 "cm"'),
    "removed unit of a constant": ('-3.5 "mm"', "-3.5"),
    "added unit of a constant": ("plain = 2", 'plain = 2 "mm"'),
    "number and unit of a constant": ('-3.5 "mm"', '1 "cm"'),
    "last element of an enumeration": ("right, none }", "right }"),
    "element between": ("left, right, none }", "left, none }"),
    "added element": ("right, none }", "right, none, both }"),
    "added first element": ("{ left, right", "{ both, left, right"),
    "added element between": ("left, right, none", "left, both, right, none"),
    "order of elements": ("left, right, none", "left, none, right"),
    "added element in its line": ("        gone\n", "        gone,\n        lost\n"),
    "removed first element in its line": ("        near,\n        far", "        far"),
    "enumeration becomes internal": ("enum side {", "enum side internal {"),
    "enumeration becomes external": ("internal_side internal {", "internal_side {"),
    "removed declaration": ("    const plain = 2;\n", ""),
    "added declaration": ("    const plain = 2;\n", "    const plain = 2;\n    const more = 3;\n"),
    "range of a parameter of a behavior": (
        'walk.speed [0..1] "m/s"; // forwards',
        'walk.speed [0..2] "m/s"; // forwards',
    ),
    "range of a parameter without one": ("float walk.turn;", "float walk.turn [0..1];"),
    "added parameter": ("float walk.turn;\n", "float walk.turn;\n        bool walk.back;\n"),
    "range of a parameter of an option": ("@wild [0..1]", "@wild [0..2]"),
    "target becomes plain": ("target state done", "state done"),
    "state becomes target": ("    state seek", "    target state seek"),
    "removed common action": (("    common action {\n        speed = 0.5; // slow\n    }\n"), ""),
    "value of a common action": ("speed = 0.5; // slow", "speed = 0.75; // slow"),
    "condition": ("ball.x > 5", "ball.x > 6"),
    "operator": ("ball.x > 3", "ball.x < 3"),
    "target of a transition": (
        "else if (ball.x > 3)\n                goto done",
        "else if (ball.x > 3)\n                goto seek",
    ),
    "added argument": ("stand();\n        }", "walk(walk.speed = 1);\n        }"),
    "argument": ("walk.turn = 1)", "walk.turn = 2)"),
    "removed argument": (", walk.turn = 1)", ")"),
    "value": ("facing = left", "facing = right"),
    "removed action": ("            facing = left;\n", ""),
    "removed last action": ("            stand();\n        }", "        }"),
    "added action": ("            stand();\n", "            stand();\n            speed = 1;\n"),
    "added action in one line": ("action { speed = 1; }", "action { speed = 1; stand(); }"),
    "moved action": (
        "            facing = left;\n            stand();\n",
        "            stand();\n            facing = left;\n",
    ),
    "added test": (
        "            else {\n",
        ("            else if (ball.x > 2) {\n                goto seek;\n            }\n            else {\n"),
    ),
    "added test in the same line": (
        "            } else if (ball.x > 3)",
        ("            } else if (ball.x > 3.5) {\n                goto seek;\n            } else if (ball.x > 3)"),
    ),
    "removed last test": (("            } else if (ball.x > 3)\n                goto done;\n"), "            }\n"),
    "removed test between": (
        ("else if (ball.x > 4) { // rather near\n                stay;\n            } else if (ball.x > 3)"),
        "else if (ball.x > 3)",
    ),
    "removed first test": (
        ("else if (ball.x > 5) {\n                goto seek;\n            } else if (ball.x > 4)"),
        "else if (ball.x > 4)",
    ),
    "added description of a test": (
        "            // is far\n            else if",
        ("            // is far\n            else /** far */\n            if"),
    ),
    "swapped tests": (
        (
            "if (ball.x > 5) {\n"
            "                goto seek;\n"
            "            } else if (ball.x > 4) { // rather near\n"
            "                stay;"
        ),
        (
            "if (ball.x > 4) { // rather near\n"
            "                stay;\n"
            "            } else if (ball.x > 5) {\n"
            "                goto seek;"
        ),
    ),
    "added first test": (
        "else if (ball.x > 5)",
        ("else if (ball.x > 9) {\n                stay;\n            } else if (ball.x > 5)"),
    ),
    "added test in one line": (
        "goto start; else stay;",
        ("goto start;\n        else if (@wild > 0.25) {\n            stay;\n        } else stay;"),
    ),
    "removed test in one line": ("if (@wild > 0.5) goto start; else stay;", "stay;"),
    "removed decision": ("        decision { else if (@wild > 0.5) goto start; else stay; }\n", ""),
    "added decision": (
        "    state spare {\n",
        (
            "    state spare {\n"
            "        decision {\n"
            "            else if (ball.seen) {\n"
            "                goto start;\n"
            "            } else {\n"
            "                stay;\n"
            "            }\n"
            "        }\n"
        ),
    ),
    "removed state": (("    // in reserve\n    state spare {\n        action { }\n    }\n\n"), ""),
    "added state": (
        "        action { }\n    }\n\n    target",
        (
            "        action { }\n"
            "    }\n"
            "\n"
            "    state more {\n"
            "        action {\n"
            "            stand();\n"
            "        }\n"
            "    }\n"
            "\n"
            "    target"
        ),
    ),
    "moved state": (
        ("    // in reserve\n    state spare {\n        action { }\n    }\n\n"),
        "",
        "    // looks around\n",
        ("    // in reserve\n    state spare {\n        action { }\n    }\n\n    // looks around\n"),
    ),
    "comment above a state": ("// begins here", "// starts here"),
    "removed comment above a state": ("    // begins here\n", ""),
    "added comment above a state": ("    target state", "    // the end\n    target state"),
    "another initial state": ("    initial state start", "    state start", "    state seek", "    initial state seek"),
    "removed common decision": (
        (
            "    common decision {\n"
            "        /** lost */\n"
            "        if (!ball.seen) // really\n"
            "            goto seek;\n"
            "    }\n"
        ),
        "",
        "else if (ball.x > 5)",
        "if (ball.x > 5)",
        "            else stay;",
        "            stay;",
        "else if (@wild",
        "if (@wild",
    ),
    "added common action": (
        "{ initial state only",
        ("{\n  common action {\n    stand();\n  }\n\n  initial state only"),
    ),
    "added common decision": (
        "{ initial state only { action",
        ("{\n  common decision {\n    if (ball.seen) {\n      goto only;\n    }\n  }\n\n  initial state only { action"),
    ),
    "added action in an empty block": (
        "        action { }\n    }\n\n    // in reserve",
        ("        action {\n            stand();\n        }\n    }\n\n    // in reserve"),
    ),
    "called option": ("action { stand(); } } }", "action { walk(); } } }"),
}
"""Old and new pieces in turns, by what they change."""


def edited(pieces: tuple[str, ...]) -> str:
    """The original with pieces replaced, given as old and new ones in turns."""
    text = ORIGINAL
    for old, new in zip(pieces[::2], pieces[1::2], strict=True):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def test_the_printed_form_is_the_same_program() -> None:
    assert patched(split(ORIGINAL), clean(ORIGINAL), clean(ORIGINAL)) == split(ORIGINAL)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_only_the_edited_piece_changes(name: str, newline: str) -> None:
    expected = edited(CASES[name])
    original = {file: text.replace("\n", newline) for file, text in split(ORIGINAL).items()}
    found = patched(original, clean(ORIGINAL), clean(expected))
    assert {file: (text or "").replace("\r\n", "\n") for file, text in found.items()} == split(expected)
    assert all((text or "").count("\n") == (text or "").count(newline) for text in found.values())
