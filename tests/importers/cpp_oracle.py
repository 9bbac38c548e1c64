"""Runs random state machines as C++ programs, with small definitions of CABSL and boost::sml."""

import random
import subprocess
from collections.abc import Iterator
from pathlib import Path

FLAGS, NUMBERS, MODES = 4, 2, ("wait", "play", "stop")

CABSL = """
#include <cstdio>
enum class Mode { wait, play, stop };
struct Field { int flags[4]; double numbers[2]; Mode mode;
  bool seen(int n) const { return flags[n]; } double x(int n) const { return numbers[n]; } };
static Field theField;
static int now, before = -1, subType;
struct Context { int state = 0, type = 0, sub = 0, start = 0, entered = 0, last = -2; bool moved = false;
  const char* shown = "";
  void begin() { if(last != before && last != now) { start = entered = now; state = type = sub = 0; } moved = false; }
  void enter(int to, int kind) { moved = true; if(state != to) { state = to; entered = now; type = kind; } }
  void end() { last = now; sub = subType; subType = type; } };
#define option(name) static Context name##_c; static void name##_b(Context& o); \\
  static void name() { name##_c.begin(); name##_b(name##_c); name##_c.end(); } static void name##_b(Context& o)
#define any_state(name, line, kind) if(false) { name: o.enter(line, kind); } if(o.state == line && (o.shown = #name))
#define initial_state(name) any_state(name, 0, 0)
#define state(name) any_state(name, __LINE__, 0)
#define target_state(name) any_state(name, __LINE__, 2)
#define aborted_state(name) any_state(name, __LINE__, 3)
#define common_transition
#define transition if(!o.moved && (o.moved = true))
#define action
#define state_time (now - o.entered)
#define option_time (now - o.start)
#define action_done (o.sub == 2)
#define VERIFY(x)
"""

SML = """
#include <cstdio>
#include <functional>
#include <string>
#include <vector>
static int flags[4];
struct Guard { std::function<bool()> test; Guard operator!() const { auto a = test; return {[=] { return !a(); }}; }
  Guard operator&&(Guard b) const { auto a = test; return {[=] { return a() && b.test(); }}; }
  Guard operator||(Guard b) const { auto a = test; return {[=] { return a() || b.test(); }}; } };
static Guard first{[] { return flags[0] != 0; }}, second{[] { return flags[1] != 0; }};
static auto hop = [] {};
struct go { static const char* name() { return "go"; } };
struct halt { static const char* name() { return "halt"; } };
struct Event { std::string name; Guard guard; Event operator[](Guard g) const { return {name, g}; }
  template<class A> Event operator/(A) const { return *this; } };
struct State;
struct Row { std::string source, event, target; Guard guard; bool initial = false;
  Row operator=(const State& to) const; };
struct State { std::string name; bool initial = false; Guard guard = {};
  State operator*() const { return {name, true, guard}; } State operator[](Guard g) const { return {name, initial, g}; }
  Row operator+(Event e) const { return {name, e.name, "", e.guard, initial}; }
  Row operator=(const State& to) const { return {name, "", to.name, guard, initial}; } };
inline Row Row::operator=(const State& to) const { return {source, event, to.name, guard, initial}; }
struct Machine { std::vector<Row> rows; std::string state;
  bool take(const std::string& event) { for(auto& row : rows)
      if(row.source == state && row.event == event && (!row.guard.test || row.guard.test())) {
        bool moved = row.target != ""; state = moved ? row.target : state; return moved || event != ""; }
    return false; }
  void settle() { for(int n = 0; n < 9 && take(""); n++); }
  void process(const std::string& event) { take(event); settle(); } };
template<class... Rows> Machine make_transition_table(Rows... rows) {
  Machine made{{rows...}, ""}; for(auto& row : made.rows) if(row.initial) made.state = row.source; return made; }
inline State operator""_s(const char* text, std::size_t) { return State{text}; }
template<class E> const Event event{E::name(), {}};
"""


def run_program(source: str, lines: list[str], folder: Path, compiler: str) -> list[str]:
    """Compile a program and return the lines that it prints for its input."""
    file = folder / "oracle.cpp"
    file.write_text(source, encoding="utf-8")
    command = [compiler, "-std=c++17", "-O0", "-w", str(file), "-o", str(folder / "oracle")]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr[:2000]
    text = "\n".join(lines) + "\n"
    return subprocess.run(
        [str(folder / "oracle")], input=text, capture_output=True, text=True, check=True
    ).stdout.splitlines()


class CabslWriter:
    """Writes random options: `Main` with two states calls `Part`."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def behavior(self, number: int) -> str:
        """Two options."""
        part = self._option(f"Part{number}", ["target_state", "state"], "")
        return part + self._option(f"Main{number}", ["state", "state", "aborted_state"], f"Part{number}")

    def _option(self, name: str, kinds: list[str], called: str) -> str:
        states = [("initial_state", "s0"), *((kind, f"s{number}") for number, kind in enumerate(kinds, start=1))]
        names = [state for _kind, state in states]
        self._random.shuffle(states)
        common = f"  common_transition\n  {{ {self._if(names, 1, '')} }}\n" if self._random.random() < 0.4 else ""
        body = "".join(self._state(kind, state, names, called) for kind, state in states)
        return f"option({name})\n{{\n{common}{body}}}\n"

    def _state(self, kind: str, name: str, names: list[str], called: str) -> str:
        done = "action_done" if called else ""
        statements = "\n      ".join(self._statement(names, 2, done) for _ in range(self._random.randint(0, 3)))
        action = f"\n    action {{ {called}(); }}" if called else ""
        return f"  {kind}({name})\n  {{\n    transition\n    {{\n      {statements}\n    }}{action}\n  }}\n"

    def _statement(self, names: list[str], depth: int, done: str) -> str:
        kind = self._random.random()
        if kind < 0.2 and depth:
            return self._switch(names, depth, done)
        return "VERIFY(now >= 0); /* goto s0; */" if kind < 0.3 else self._if(names, depth, done)

    def _if(self, names: list[str], depth: int, done: str) -> str:
        goto = f"goto {self._random.choice(names)};"
        then = f"{{ {self._statement(names, depth - 1, done)} }}" if depth and self._random.random() < 0.4 else goto
        text = f"if({self._condition(2, done)}) {then}"
        kind = self._random.random()
        if kind < 0.3 and depth:
            return f"{text} else {self._if(names, depth - 1, done)}"
        return f"{text} else {{ // or else\n {self._if(names, 0, done)} }}" if kind < 0.4 else text

    def _switch(self, names: list[str], depth: int, done: str) -> str:
        cases = ""
        for label in self._random.sample(MODES, 2):
            leave = self._random.choice(["break;", "break;", f"if({self._condition(1, done)}) break;", ""])
            cases += f"case Mode::{label}: {self._if(names, depth - 1, done)} {leave} "
        default = f"default: {self._if(names, 0, done)}" if self._random.random() < 0.5 else ""
        return f"switch(theField.mode) {{ {cases}{default} }}"

    def _condition(self, depth: int, done: str) -> str:
        if depth and self._random.random() < 0.5:
            sign = self._random.choice(["&&", "||", "and", "or"])
            parts = f"{self._condition(depth - 1, done)} {sign} {self._condition(depth - 1, done)}"
            return self._random.choice([parts, f"!({parts})", f"({parts})"])
        number, sign = self._random.randrange(FLAGS), self._random.choice(["<", ">", "<=", ">=", "==", "!="])
        atoms = [
            f"theField.seen({number})",
            f"!theField.seen( {number} )",
            f"theField.x({number % NUMBERS}) {sign} {self._random.choice(['1', '2.f', '-1', '.5'])}",
            f"{self._random.randint(0, 2)} {sign} theField.x(0)",
            f"theField.x(0) {sign} theField.x(1)",
            f"theField.mode {self._random.choice(['==', '!='])} Mode::{self._random.choice(MODES)}",
            f"state_time > {self._random.choice([20, 60])}",
            f"option_time >= {self._random.choice([60, 100])}",
            *([done] if done else []),
        ]
        return self._random.choice(atoms)


def cabsl_main(numbers: range) -> str:
    """A program that runs the options `Main0` … and prints their states in each frame."""
    steps = "".join(f'    Main{n}(); printf("%s/%s ", Main{n}_c.shown, Part{n}_c.shown);\n' for n in numbers)
    return f"""
int main() {{ int a, b, c, d, mode, time; double x, y;
  while(scanf("%d %d %d %d %lf %lf %d %d", &a, &b, &c, &d, &x, &y, &mode, &time) == 8) {{
    theField = {{{{a, b, c, d}}, {{x, y}}, static_cast<Mode>(mode)}}; now = time;
{steps}    before = now; printf("\\n"); }} }}
"""


def sml_main(count: int) -> str:
    """A program that lets the machines `M0` … process the same events, and prints their states."""
    made = "".join(f"  auto m{n} = M{n}()();\n" for n in range(count))
    steps = "".join(f'    m{n}.process(e ? "go" : "halt"); printf("%s ", m{n}.state.c_str());\n' for n in range(count))
    read = 'while(scanf("%d %d %d", &e, &flags[0], &flags[1]) == 3)'
    return f'int main() {{ int e;\n{made}  {read} {{\n{steps}    printf("\\n"); }} }}\n'


def sml_machines(seed: int, count: int) -> Iterator[str]:
    """Classes `M0` … with random tables of four states, two events, and a row without event."""
    chooser = random.Random(seed)
    for number in range(count):
        rows = [f'*"s0"_s + event<go> / hop = "s{chooser.randint(1, 3)}"_s']
        if number % 2:
            rows.append('"s3"_s = "s0"_s')
        for _ in range(14):
            source, target = chooser.randint(0, 3), chooser.randint(0, 3)
            guard = chooser.choice(["", "[first]", "[!first]", "[first && !second]", "[!(first || second)]"])
            does = chooser.choice(["", " / hop", " / [] { int X = 1; (void)X; }"])
            leads = chooser.choice(["", f' = "s{target}"_s', f' = "s{target}"_s'])
            event = chooser.choice(["go", "halt"])
            does = does if does or leads else " / hop"
            rows.append(f'"s{source}"_s + event<{event}> {guard}{does}{leads}')
        table = "\n    , ".join(dict.fromkeys(rows))
        body = f"return make_transition_table(\n      {table});"
        yield f"struct M{number} {{ auto operator()() const {{\n  {body} }} }};\n"
