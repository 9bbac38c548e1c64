"""Edits of the generated source of the sample player in C++, as a person makes them."""

from dataclasses import dataclass

Replacement = tuple[str, str]


@dataclass(frozen=True)
class PlayerEdit:
    """Replacements in the source, with the edits of the design in words; none if the edit stays a patch."""

    replacements: tuple[Replacement, ...]
    words: tuple[str, ...] = ()
    reason: str = ""


_IF_SEEN = "            if (perception.ball_seen) {\n"
_SEEN = f"{_IF_SEEN}                change_to(State::FollowBall);\n                return;\n            }}\n"
_LOST = "perception.ball_age > lost_after"
_END_IF = "                return;\n            }\n"
_IF_LOST = f"            if ({_LOST}) {{\n                change_to(State::LookForBall);\n{_END_IF}"
_BUSY = "state_time_ns() >= 500'000'000 && !kicker.busy"
_COUNT = "            kicks += 1;\n"
_NARROW = "bica::abs(perception.neck_pan) < 20.0"
_AT_FEET = "perception.bottom_camera and perception.neck_tilt > near_tilt"
_FEET = "guard of FollowBall → SearchNet: "
_CENTERED = "abs(perception.ball_y) < centered"
_END = "name_of(side), bearing);\n    // </vicode>\n"
_PRINT = '    std::printf("kicked\\n");\n'
_INCLUDE = '#include "forward/player.hpp"\n'
_KICK = "    // <vicode Kick.enter"
_ENTER = "enter action of state Kick: "


def _one(old: str, new: str, *words: str, reason: str = "") -> PlayerEdit:
    return PlayerEdit(((old, new),), words, reason)


PLAYER_EDITS: dict[str, PlayerEdit] = {
    # Statements beside a region
    "statement behind a region": _one(_END, _END + _PRINT, f'{_ENTER}std::printf("kicked\\n");'),
    "statement before a region": _one(_KICK, _PRINT + _KICK, f'{_ENTER}cpp: std::printf("kicked\\n"); …'),
    "renamed function of a region": PlayerEdit(
        (("do_kick_enter();", "do_log_kick();"), ("::do_kick_enter", "::do_log_kick")), reason="do_log_kick"
    ),
    "removed call of a region": _one("            do_watch_ball();\n", "", reason="but its code was not"),
    # Tests
    "dropped operand": _one(f" &&\n                {_NARROW}", "", f"{_FEET}{_AT_FEET} and {_CENTERED}"),
    "added operand": _one(
        "(perception.ball_seen) {",
        "(perception.ball_seen && kicks < 3) {",
        "guard of LookForBall → FollowBall: perception.ball_seen and kicks < 3",
    ),
    "number": _one("< 20.0", "< 25", f"{_FEET}{_AT_FEET} and abs(perception.neck_pan) < 25 and {_CENTERED}"),
    "truth of a number": _one(
        "(perception.ball_seen) {",
        "(perception.ball_seen && !kicks) {",
        "guard of LookForBall → FollowBall: perception.ball_seen and not kicks != 0",
    ),
    "function of the standard library": _one(
        _NARROW,
        "std::abs(perception.neck_pan) < 21.0",
        f"{_FEET}{_AT_FEET} and abs(perception.neck_pan) < 21 and {_CENTERED}",
    ),
    "function of C": _one(_NARROW, "abs(perception.neck_pan) < 21.0", reason="abs"),
    "whole number divided": _one("< 20.0", "< 41 / 2", reason="generates other code"),
    "octal number": _one("< 20.0", "< 020", reason="020"),
    "word for an operator": _one(
        _BUSY, "state_time_ns() >= 600'000'000 and not kicker.busy", "time of Kick → WatchBall: 0.6"
    ),
    "time behind another test": _one(
        _BUSY, "!kicker.busy && state_time_ns() >= 1'500'000'000", "time of Kick → WatchBall: 1.5"
    ),
    "cast": _one(
        _LOST, "static_cast<double>(kicks) > lost_after", "guard of FollowBall → LookForBall: kicks > lost_after"
    ),
    "this": _one(
        "(perception.ball_seen) {",
        "(this->kicks > 2) {",
        "guard of LookForBall → FollowBall: kicks > 2",
    ),
    # Decisions
    "added if": _one(
        f"            // ball lost\n{_IF_LOST}",
        "            // far left\n            if (perception.ball_x > 30) {\n"
        f"                change_to(State::SearchNet);\n{_END_IF}            // ball lost\n{_IF_LOST}",
        "added transition FollowBall → SearchNet: when perception.ball_x > 30",
    ),
    "removed if": _one(
        f"            // ball lost\n{_IF_LOST}",
        "",
        f"removed transition FollowBall → LookForBall: when {_LOST}",
    ),
    "target": _one("change_to(State::FollowBall)", "change_to(State::GetUp)", "target of LookForBall → GetUp: GetUp"),
    "if without braces": _one(
        _SEEN,
        f"{_SEEN}            if (perception.ball_distance > 3)\n                return;\n",
        "added stay in LookForBall: when perception.ball_distance > 3",
    ),
    "chain of tests": _one(
        "            }\n            // ball at the feet\n            if (perception.bottom_camera",
        "            } else if (perception.bottom_camera",
        "description of FollowBall → SearchNet: (none)",
    ),
    "comment": _one(
        "// ball seen",
        "// the ball is seen at last",
        "description of LookForBall → FollowBall: the ball is seen at last",
    ),
    "local variable in a decision": _one(
        f"            // ball lost\n            if ({_LOST}",
        "            const auto age = perception.ball_age;\n            // ball lost\n            if (age > lost_after",
        reason="const auto age",
    ),
    "statement in a decision": _one(
        _IF_SEEN, f'{_IF_SEEN}                std::printf("seen\\n");\n', reason='std :: printf ( "seen\\n" ) ;'
    ),
    # Actions
    "added set": _one(
        _COUNT, f"{_COUNT}            side = Side::left;\n", "added enter action of state Kick: set side: Side.left"
    ),
    "incremented in a new case": _one(
        "        case State::CircleBall:\n            side =",
        "        case State::SearchNet:\n            ++kicks;\n            break;\n"
        "        case State::CircleBall:\n            side =",
        "added enter action of state SearchNet: set kicks: kicks + 1",
    ),
    "argument": _one("/*speed=*/210.0", "250", "modulation of follow_ball in state FollowBall: speed: 250"),
    "added call": _one(
        "            call(search_ball, {}, calls_);\n",
        "            call(search_ball, {}, calls_);\n            call(walk, {100.0}, calls_);\n",
        "added modulation of walk in state LookForBall: forward: 100.0",
    ),
    "removed call": _one(
        "            call(face_ball, {}, calls_);\n            call(kicker",
        "            call(kicker",
        "removed modulation of face_ball in state Kick",
    ),
    "log line": _one(
        _COUNT,
        f'{_COUNT}            std::printf("kick!\\n");\n',
        'added enter action of state Kick: cpp: std::printf("kick!\\n");',
    ),
    "static counter": _one(
        _COUNT,
        f"            static int tries = 0;\n            ++tries;\n{_COUNT}",
        "added enter action of state Kick: cpp: static int tries = 0; ++tries;",
    ),
    "if in actions": _one(
        _COUNT,
        f"{_COUNT}            if (kicks > 9) {{\n                side = Side::left;\n            }}\n",
        "added enter action of state Kick: cpp: if (kicks > 9) { side = Side::left; }",
    ),
    "early return": _one(
        "BICA_INLINE void Player::act() {\n",
        "BICA_INLINE void Player::act() {\n    if (perception.fallen) {\n        return;\n    }\n",
        reason="statements outside the cases of the states",
    ),
    "variable that hides a member": _one(_COUNT, f"            double kicks = 0;\n{_COUNT}", reason="double kicks = 0"),
    "comment between actions": _one(_COUNT, f"            // count\n{_COUNT}", reason="// count"),
    "lambda": _one(_COUNT, "            kicks += [&] { return 1; }();\n", reason="kicks += [ &"),
    # Files
    "frequency": _one('"Player", 10.0', '"Player", 20', "frequency: 20"),
    "resume": _one("(*this, false)", "(*this, true)", "resume: yes"),
    "include": _one(_INCLUDE, f"{_INCLUDE}#include <iostream>\n", reason="outside functions"),
    "include with its use": PlayerEdit(
        ((_INCLUDE, f"{_INCLUDE}#include <iostream>\n"), (_COUNT, f"{_COUNT}            std::cout << kicks;\n")),
        reason="std :: cout",
    ),
    "macro": PlayerEdit(
        (
            ("namespace forward {\n", "#define LIMIT 3.0\n\nnamespace forward {\n"),
            (_LOST, "perception.ball_age > LIMIT"),
        ),
        reason="a macro",
    ),
    "constant": PlayerEdit(
        (
            ("namespace forward {\n", "namespace forward {\n\nconstexpr double limit = 3.0;\n"),
            (_LOST, "perception.ball_age > limit"),
        ),
        reason="limit",
    ),
    "function": _one(
        "void Player::forget_calls",
        "static double half(double x) { return x / 2; }\n\nvoid Player::forget_calls",
        reason="half",
    ),
}


def edit_player(text: str, name: str) -> str:
    """Return the source after an edit; its project may have another name."""
    package = text.split('#include "', 1)[1].split("/", 1)[0]
    for old, new in PLAYER_EDITS[name].replacements:
        found, written = (each.replace("forward", package) for each in (old, new))
        assert found in text, found
        text = text.replace(found, written, 1)
    return text
