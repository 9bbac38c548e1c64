"""An edit of a declaration, a parameter or an agent changes its tokens only; the layout of the rest stays."""

from collections.abc import Sequence

import pytest

from vicode.xabsl import tree
from vicode.xabsl.parser import parse
from vicode.xabsl.patching.declaration_edits import edit_agent, edit_declaration, edit_declarations
from vicode.xabsl.patching.source_edits import SourceEdits

BEGIN, END = 'namespace n ("N") {\n', "\n}\n"


def parsed(text: str) -> tuple[SourceEdits, tree.NamespaceNode]:
    """The declarations in a namespace."""
    file = SourceEdits(parse(BEGIN + text + END, "n.xabsl"))
    (namespace,) = file.parsed.file.body
    assert isinstance(namespace, tree.NamespaceNode)
    return file, namespace


def written(file: SourceEdits) -> str:
    text = file.result()
    assert text.startswith(BEGIN)
    assert text.endswith(END)
    return text.removeprefix(BEGIN).removesuffix(END)


def edited(old: str, after: str, before: str = "") -> str:
    """Edit the last of the declarations; `before` is the form in which `after` is generated, if it is another one."""
    file, namespace = parsed(old)
    versions = (parsed(text)[1].declarations[-1] for text in (before or old, after))
    edit_declaration(file, namespace.declarations[-1], *versions)
    return written(file)


# Old, after, and the result.
DOCS = {
    "added above": ("  bool input a;", "/** x\n y */ bool input a;", "  /** x y */\n  bool input a;"),
    "added in a line": (
        "  const a = 1; const b  = 2;",
        "const a = 1; /** x */ const b = 2;",
        "  const a = 1; /** x */ const b  = 2;",
    ),
    "removed": ("  /** x */\n  bool input  a;", "bool input a;", "  bool input  a;"),
    "removed in a line": ("  /** x */ bool input  a;", "bool input a;", "  bool input  a;"),
    "changed": ("  /** one\n  two */ const a=1;", "/** one three */ const a = 1;", "  /** one\n  three */ const a=1;"),
    "and number": ("  /** x */\n  const a=1; // c", "/** y */ const a = 2;", "  /** y */\n  const a=2; // c"),
}

CONSTANTS = {
    "number": ('  const  a  =  1  "m" ;', 'const a = 2 "m";', '  const  a  =  2  "m" ;'),
    "sign added": ("const a = 1 ;", "const a = -1;", "const a = -1 ;"),
    "sign removed": ('const a = - 1  "m" ;', 'const a = 1 "m";', 'const a = 1  "m" ;'),
    "negative": ("const a = -1;", "const a = -2;", "const a = -2;"),
    "unit": ('const a  = 1  "m" ;', 'const a = 1 "mm";', 'const a  = 1 "mm" ;'),
    "unit of a negative one": ('const a  = - 1  "m" ;', 'const a = -1 "mm";', 'const a  = - 1 "mm" ;'),
    "unit added": ("const a  = 1 ;", 'const a = 1 "m";', 'const a  = 1 "m" ;'),
    "unit removed": ('const a  = 1  "m" ;', "const a = 1;", "const a  = 1 ;"),
    "both": ('const a  = 1  "m" ;', 'const a = -2 "s";', 'const a  = -2 "s" ;'),
}

ENUMERATIONS = {
    "internal": ("enum  a  { x } ;", "enum a internal { x };", "enum  a internal  { x } ;"),
    "external": ("enum  a  internal  { x } ;", "enum a { x };", "enum  a  { x } ;"),
    "internal, with an element": ("enum  a  {x};", "enum a internal { x, y };", "enum  a internal  {x, y};"),
    "removed first": ("enum a {x ,  y , z} ;", "enum a { y, z };", "enum a {y , z} ;"),
    "removed first two": ("enum a {x ,  y , z} ;", "enum a { z };", "enum a {z} ;"),
    "removed between": ("enum a {x ,  y , z} ;", "enum a { x, z };", "enum a {x , z} ;"),
    "removed last": ("enum a {x ,  y , z} ;", "enum a { x, y };", "enum a {x ,  y} ;"),
    "removed last two": ("enum a {x ,  y , z} ;", "enum a { x };", "enum a {x} ;"),
    "added first": ("enum a {x ,  y} ;", "enum a { w, x, y };", "enum a {w, x ,  y} ;"),
    "added first two": ("enum a {x ,  y} ;", "enum a { v, w, x, y };", "enum a {v, w, x ,  y} ;"),
    "added between": ("enum a {x ,  y} ;", "enum a { x, w, y };", "enum a {x, w ,  y} ;"),
    "added last two": ("enum a {x ,  y} ;", "enum a { x, y, v, w };", "enum a {x ,  y, v, w} ;"),
    "added in lines": (
        "enum a {\n    x,\n    y\n  } ;",
        "enum a { x, y, z };",
        "enum a {\n    x,\n    y,\n    z\n  } ;",
    ),
    "added first in lines": ("enum a {\n x,\n y\n};", "enum a { w, x, y };", "enum a {\n w,\n x,\n y\n};"),
    "added to one in a line of its own": ("enum a {\n    x\n  };", "enum a { x, y };", "enum a {\n    x, y\n  };"),
    "added where the last shares a line": ("enum a {\n x, y};", "enum a { x, y, z };", "enum a {\n x, y, z};"),
    "added to a last line": (
        "enum a { x, y,\n    z};",
        "enum a { x, y, z, w };",
        "enum a { x, y,\n    z,\n    w};",
    ),
    "another order": ("enum a {x ,  y , z} ;", "enum a { y, x, z };", "enum a {y, x, z} ;"),
    "all others": ("enum a {x ,  y} ;", "enum a { v, w };", "enum a {v, w} ;"),
    "removed and added": ("enum a {x ,  y} ;", "enum a { y, z };", "enum a {y, z} ;"),
}

SYMBOLS = {
    "range": ("float  input a [0..1] ;", "float input a [0..2];", "float input a [0..2] ;"),
    "unit": ('float input  a "m" ;', 'float input a "s";', 'float input a "s" ;'),
    "type": ("float  input a ;", "bool input a;", "bool input a ;"),
    "direction": ("float  input a ;", "float output a;", "float output a ;"),
    "range after a description": (
        "/** d */  float input a ;",
        "/** d */ float input a [0..1];",
        "/** d */  float input a [0..1] ;",
    ),
    "type with parameters": (
        "float  input a ( bool  a.b ; ) ;",
        "bool input a(bool a.b;);",
        "bool input a ( bool  a.b ; ) ;",
    ),
    "range of a parameter": (
        "float  input a ( float  a.b ; ) ;",
        "float input a(float a.b [0..1];);",
        "float  input a ( float a.b [0..1] ; ) ;",
    ),
    "parameter and direction": (
        "float  input a ( float  a.b ; ) ;",
        "float internal a(bool a.b;);",
        "float internal a ( bool a.b ; ) ;",
    ),
    "first parameter": ("float  input a ;", "float input a(float a.b;);", "float input a(float a.b;);"),
    "removed parameters": (
        "/** d */  float  input a ( float a.b ; ) ; // c",
        "/** d */ float input a;",
        "/** d */  float input a; // c",
    ),
    "added parameter in lines": (
        "    float input  a (\n        float a.b; // c\n    );",
        "float input a(float a.b; bool a.c;);",
        "    float input  a (\n        float a.b; // c\n        bool a.c;\n    );",
    ),
    "removed parameter in a line": (
        "bool input  a ( float a.b; bool a.c; );",
        "bool input a(bool a.c;);",
        "bool input  a ( bool a.c; );",
    ),
}

BEHAVIORS = {
    "type": (
        "behavior  a { float  a.b [0..1] ; }",
        "behavior a { bool a.b [0..1]; }",
        "behavior  a { bool a.b [0..1] ; }",
    ),
    "unit": ('behavior  a { a.b  "m" ; }', 'behavior a { a.b "s"; }', 'behavior  a { a.b "s" ; }'),
    "range": (
        "behavior  a { /** d */  a.b ; }",
        "behavior a { /** d */ a.b [0..1]; }",
        "behavior  a { /** d */  a.b [0..1] ; }",
    ),
    "description": (
        "behavior a {\n    a.b ;\n  }",
        "behavior a { /** d */ a.b; }",
        "behavior a {\n    /** d */\n    a.b ;\n  }",
    ),
    "moved": (
        "behavior a {\n    a.b ; // b\n    a.c  ; // c\n  }",
        "behavior a { a.c; a.b; }",
        "behavior a {\n    a.c  ; // c\n    a.b ; // b\n  }",
    ),
    "moved and changed": (
        "behavior a {\n    a.b ;\n    a.c  ;\n  }",
        "behavior a { bool a.c; a.b; }",
        "behavior a {\n    bool a.c  ;\n    a.b ;\n  }",
    ),
    "removed and added": (
        "behavior a {\n    a.b  ;\n    a.c ;\n  }",
        "behavior a { a.b; /** e */ a.d; }",
        "behavior a {\n    a.b  ;\n    /** e */\n    a.d;\n  }",
    ),
}


@pytest.mark.parametrize("case", [*DOCS.values(), *CONSTANTS.values(), *ENUMERATIONS.values()])
def test_an_edit_changes_its_tokens(case: tuple[str, str, str]) -> None:
    old, after, expected = case
    assert edited(old, after) == expected


@pytest.mark.parametrize("case", [*SYMBOLS.values(), *BEHAVIORS.values()])
def test_an_edit_of_a_declaration_with_parameters_changes_its_tokens(case: tuple[str, str, str]) -> None:
    old, after, expected = case
    assert edited(old, after) == expected


def test_a_declaration_of_another_kind_replaces_the_old_one() -> None:
    assert edited("/** d */  enum a  { x }; // c", "/** e */ const a = 1;") == "/** e */  const a = 1; // c"


@pytest.mark.parametrize(
    ("old", "before", "after", "expected"),
    [
        (
            "/** d */ behavior a { a.x; a.b ; }",
            "/** d */ behavior a { a.b; }",
            "/** e */ behavior a { a.b; }",
            "/** e */ behavior a { a.x; a.b ; }",
        ),
        ("enum a {x , y};", "enum a { x };", "enum a internal { x };", "enum a internal {x , y};"),
        ("enum a {x , y};", "const a = 1;", "const a = 1;", "enum a {x , y};"),
    ],
)
def test_what_differs_in_the_file_stays_without_an_edit(old: str, before: str, after: str, expected: str) -> None:
    assert edited(old, after, before) == expected


@pytest.mark.parametrize(
    ("old", "before", "after", "expected"),
    [
        # The file has parentheses that the generator does not write.
        ("float  input a ( );", "float input a;", "bool input a;", "bool input a ( );"),
        ("float  input a ( );", "float input a();", "bool input a();", "bool input a ( );"),
        ("float  input a ( );", "float input a;", "float input a(bool a.b;);", "float input a(bool a.b;);"),
        ("float  input a ;", "float input a();", "float input a(bool a.b;);", "float input a(bool a.b;);"),
        ("float  input a ;", "float input a();", "bool input a();", "bool input a ;"),
        # A parameter of the file that the generator does not write, and one that it writes for another.
        ("behavior a { a.x; a.b ; }", "behavior a { a.b; }", "behavior a { bool a.b; }", "behavior a { bool a.b ; }"),
        (
            "behavior a { a.x; a.b ; }",
            "behavior a { a.x; a.c; a.b; }",
            "behavior a { a.x; bool a.c; a.b; }",
            "behavior a { a.x; bool a.c; a.b ; }",
        ),
    ],
)
def test_an_edit_of_what_differs_in_the_file(old: str, before: str, after: str, expected: str) -> None:
    assert edited(old, after, before) == expected


@pytest.mark.parametrize(
    ("old", "before", "after", "expected"),
    [
        (
            "/** d */ float input a  [x] ;",
            "/** d [x] */ float input a;",
            "/** e [x] */ float input a;",
            "/** e */ float input a  [x] ;",
        ),
        (
            "/** d */ float input a  [x] ;",
            "/** d [x] */ float input a;",
            "/** d */ float input a;",
            "/** d */ float input a ;",
        ),
        (
            "/** d */ float input a  [x] ;",
            "/** d [x] */ float input a;",
            "/** e [y] */ float input a;",
            "/** e [y] */ float input a ;",
        ),
        (
            "float input a  [x] ;",
            "/** [x] */ float input a;",
            "/** d [x] */ float input a;",
            "/** d */\nfloat input a  [x] ;",
        ),
        (
            "/** d */ float input a  [0..1] ;",
            "/** d */ float input a [0..1];",
            "/** e */ float input a [0..1];",
            "/** e */ float input a  [0..1] ;",
        ),
        (
            "/** d [] */ float input  a;",
            "/** d [] */ float input a;",
            "/** e [] */ float input a;",
            "/** e [] */ float input  a;",
        ),
        (
            "behavior a { /** d */ a.b  [x]; }",
            "behavior a { /** d [x] */ a.b; }",
            "behavior a { /** e [x] */ a.b; }",
            "behavior a { /** e */ a.b  [x]; }",
        ),
    ],
)
def test_a_range_that_an_import_appends_to_the_description(old: str, before: str, after: str, expected: str) -> None:
    """An import keeps a range that is not a pair of numbers at the end of the description."""
    assert edited(old, after, before) == expected


@pytest.mark.parametrize(
    "old",
    [
        '/** d */  const  a  =  - 1  "m" ;',
        "enum  a  internal  { x , y } ;",
        'bool  input  a  [0..1]  "m"  ( bool  a.b ; ) ;',
        "behavior  a  { /** d */  a.b  [0..1] ; }",
    ],
)
def test_without_a_change_each_character_stays(old: str) -> None:
    assert edited(old, old) == old
    # A change elsewhere in the declaration leaves the rest.
    assert edited(f"/** one */ {old.removeprefix('/** d */')}", f"/** two */ {old.removeprefix('/** d */')}") == (
        f"/** two */ {old.removeprefix('/** d */')}"
    )


# Agents


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ('agent a("A", b);', 'agent a("A", b);', '  agent  a  ( "A" , b ) ;'),
        ('agent a("A", b);', '/** x */ agent a("A", b);', '  /** x */\n  agent  a  ( "A" , b ) ;'),
        ('agent a("A", b);', 'agent a("B", b);', '  agent  a  ( "B" , b ) ;'),
        ('agent a("A", b);', 'agent a("A", c);', '  agent  a  ( "A" , c ) ;'),
        ('agent a("A", b);', 'agent a("B", c);', '  agent  a  ( "B" , c ) ;'),
        # What differs in the file stays without an edit.
        ('agent a("X", b);', 'agent a("X", c);', '  agent  a  ( "A" , c ) ;'),
        ('agent a("A", x);', 'agent a("B", x);', '  agent  a  ( "B" , b ) ;'),
    ],
)
def test_an_agent_is_changed(before: str, after: str, expected: str) -> None:
    file = SourceEdits(parse('  agent  a  ( "A" , b ) ;', "agents.xabsl"))
    old, was, now = (
        each
        for text in (file.text, before, after)
        for each in parse(text, "agents.xabsl").file.body
        if isinstance(each, tree.AgentNode)
    )
    edit_agent(file, old, was, now)
    assert file.result() == expected


# Lists of declarations

LIST = "    // one\n    const  a = 1;\n    const  b = 2; // two\n\n    behavior  c { }"


def rearranged(old: str, new: Sequence[str | int], known: dict[int, str] | None = None) -> str:
    """The declarations after a change: `new` are the indices of those that remain, and the texts of added ones."""
    file, namespace = parsed(old)
    versions = {
        index: (namespace.declarations[index], parsed(text)[1].declarations[0]) for index, text in (known or {}).items()
    }
    items = [item if isinstance(item, int) else parsed(item)[1].declarations[0] for item in new]
    edit_declarations(file, namespace, versions, items)
    return written(file)


@pytest.mark.parametrize(
    ("new", "expected"),
    [
        ([0, 1, 2], LIST),
        ([1, 2], "    const  b = 2; // two\n\n    behavior  c { }"),
        ([0, 2], "    // one\n    const  a = 1;\n\n    behavior  c { }"),
        ([1, 0, 2], "    const  b = 2; // two\n    // one\n    const  a = 1;\n\n    behavior  c { }"),
        (
            [0, 1, 2, "/** d */ behavior d { /** e */ d.e; }"],
            f"{LIST}\n    /** d */\n    behavior d {{\n        /** e */\n        d.e;\n    }}",
        ),
        (["const d = 4;", 0, 1, 2], f"    const d = 4;\n{LIST}"),
    ],
)
def test_declarations_are_removed_moved_and_added(new: list[str | int], expected: str) -> None:
    assert rearranged(LIST, new) == expected


def test_a_moved_declaration_keeps_its_edits() -> None:
    found = rearranged(LIST, [1, 0, 2], {0: "const a = 7;", 1: "const b = 8;"})
    assert found == "    const  b = 8; // two\n    // one\n    const  a = 7;\n\n    behavior  c { }"


@pytest.mark.parametrize(
    ("old", "indent"),
    [("  const a = 1;", "  "), ("\tconst a = 1;", "\t"), ("const a = 1;", ""), ("", "  ")],
)
def test_an_added_declaration_has_the_indentation_of_the_others(old: str, indent: str) -> None:
    unit = indent or "  "
    added = f"{indent}behavior b {{\n{indent}{unit}/** c */\n{indent}{unit}b.c;\n{indent}}}"
    kept: list[str | int] = [0] if old else []
    assert rearranged(old, [*kept, "behavior b { /** c */ b.c; }"]).strip("\n") == f"{old}\n{added}".strip("\n")


def test_an_added_declaration_is_indented_as_the_namespace_if_the_others_stand_in_its_line() -> None:
    file = SourceEdits(parse('  namespace n ("N") { const a = 1; }', "n.xabsl"))
    (namespace,) = file.parsed.file.body
    assert isinstance(namespace, tree.NamespaceNode)
    behavior = parsed("behavior b { /** c */ b.c; }")[1].declarations[0]
    edit_declarations(file, namespace, {}, [0, behavior])
    expected = "\n    behavior b {\n      /** c */\n      b.c;\n    }"
    assert file.result() == f'  namespace n ("N") {{ const a = 1;{expected} }}'
