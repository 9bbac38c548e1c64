"""A behavior as a person writes it, with tabs, separators and comments."""

import difflib

from tests.services.imported_behavior.test_behavior_update import updated
from vicode.model.project import Project

AGENTS = """\
/* ---------------- *
 *  Player          *
 * ---------------- */

// Symbols
include "Symbols/ball.xabsl";

// Set plays
include "Options/SetPlays/kickoff.xabsl";  // TO CHECK

/** the one */
agent player("Player", kickoff);
"""
SYMBOLS = """\
namespace ball("Ball")
{
\tenum side {
\t\tleft,
\t\tright
\t};

\t/** where it is */
\tfloat input ball.x [-4500..4500] "mm";  // field
\tbool  input ball.seen;
\tenum side input ball.side;

\t// ---- outputs ----
\tfloat output speed;
\tfloat const near = 100 "mm";
}
"""
ACTS = """\
namespace acts("Acts")
{
\tbehavior walk { float speed; bool fast; }
}
"""
KICKOFF = """\
/** Plays the
  * kick-off. */
option kickoff
{
\tfloat @reach "mm";

\t// ----------------------------------------

\t// waits for the
\t// referee
\tinitial state wait {
\t\tdecision {
\t\t\t// is it near?
\t\t\tif((ball.x<near)  &&  ball.seen) { // now
\t\t\t\tgoto kick;
\t\t\t} else if(ball.side==left) {
\t\t\t\t/* to the left */ goto turn;
\t\t\t} else {
\t\t\t\tstay;
\t\t\t}
\t\t}
\t\taction {
\t\t\t// slowly
\t\t\tspeed=10;   // mm/s
\t\t\twalk(speed=ball.x*2,
\t\t\t     fast=false);
\t\t}
\t}

\t// turns
\tstate turn {
\t\tdecision {
\t\t\tif(state_time>=500) goto wait;
\t\t\telse stay;
\t\t}
\t\taction { }
\t}

\t/* state old { } */

\ttarget state kick
\t{
\t\taction {
\t\t\twalk(fast=true);
\t\t}
\t}
}
"""
TEXTS = {
    "agents.xabsl": AGENTS.replace('ball.xabsl";\n', 'ball.xabsl";\ninclude "Symbols/acts.xabsl";\n'),
    "Symbols/ball.xabsl": SYMBOLS,
    "Symbols/acts.xabsl": ACTS,
    "Options/SetPlays/kickoff.xabsl": KICKOFF,
}


def changed_lines(project: Project) -> list[str]:
    new = updated(TEXTS, project)
    lines = []
    for name in sorted({**TEXTS, **new}):
        pair = [texts.get(name, "").splitlines() for texts in (TEXTS, new)]
        matcher = difflib.SequenceMatcher(None, *pair, autojunk=False)
        for tag, first, last, new_first, new_last in matcher.get_opcodes():
            if tag != "equal":
                lines += [f"- {line.strip()}".strip() for line in pair[0][first:last]]
                lines += [f"+ {line.strip()}".strip() for line in pair[1][new_first:new_last]]
    return lines


def paired(lines: list[str]) -> list[str]:
    """Lines in an order that does not depend on how changes are grouped."""
    return sorted(line for line in lines)
