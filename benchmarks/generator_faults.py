"""Faults of generators, of the C++ runtime and of the simulator for `benchmarks.planted_faults`."""

from benchmarks.fault_table import ALL, CPP, PYTHON, XABSL, Fault

_HPP = "templates/cpp/bica.hpp"
_CPP_LEAVE = """        if any(state.leave for state in plan.states):
            body.append("    leave();")
        requires = requirements_differ(plan)
        if requires:
            body.append("    const std::uint64_t required = required_by(state_);")
        body += ["    change_state(transition);", "    state_ = next;"]
"""
_CPP_LEAVE_LATE = """        requires = requirements_differ(plan)
        if requires:
            body.append("    const std::uint64_t required = required_by(state_);")
        body += ["    change_state(transition);", "    state_ = next;"]
        if any(state.leave for state in plan.states):
            body.append("    leave();")
"""

GENERATOR_FAULTS = (
    Fault(
        "vicode/generators/plan/component.py",
        "action_done without common calls",
        "actions = (*self.design.common.actions, *state.all_actions)",
        "actions = state.all_actions",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/component.py",
        "no else of groups",
        'otherwise=self.plan_decisions(otherwise, source, (*path, "else")),',
        "otherwise=(),",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/component.py",
        "modulates lost",
        "self.plan_steps(state.all_actions, state.name",
        "self.plan_steps(state.actions, state.name",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/component.py", "disabled parts active", "design = strip_disabled(design)", "pass", ALL
    ),
    Fault(
        "vicode/generators/plan/component.py",
        "no report of a cooperative state",
        "if not is_cooperative or any(",
        "if is_cooperative or not is_cooperative or any(",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/typed_expressions.py",
        "timers truncated",
        "return round(ns) if math.isfinite(ns) else None",
        "return int(ns) if math.isfinite(ns) else None",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/typed_expressions.py",
        "timers in whole milliseconds",
        "return round(ns) if math.isfinite(ns) else None",
        "return round(ns / 1e6) * 1_000_000 if math.isfinite(ns) else None",
        ALL,
    ),
    Fault(
        "vicode/generators/plan/typed_expressions.py",
        "-0 as a float is 0.0",
        "return replace(node, operand=as_type(operand, FLOAT), type=FLOAT)",
        'return FunctionCall(function="float", arguments=(node,), type=FLOAT, span=node.span)',
        ALL,
    ),
    Fault(
        "vicode/generators/python/methods.py",
        "common transitions tested after a change",
        "if decide and self._decide_common():",
        "if self._decide_common():",
        PYTHON,
    ),
    Fault(
        "vicode/generators/python/methods.py",
        "common actions after those of the state",
        '        if self.component.common_actions:\n            lines.append(f"{margin}self._act_common()")\n'
        "        return [*lines, *self._steps(state.actions)]",
        "        lines += self._steps(state.actions)\n        if self.component.common_actions:\n"
        '            lines.append(f"{margin}self._act_common()")\n        return lines',
        PYTHON,
    ),
    Fault(
        "vicode/generators/python/methods.py",
        "then and else_if not exclusive",
        "if outcome.then_always_ends:\n            return [*lines, *self._decide(outcome.otherwise, indent, ended)]",
        "if outcome.otherwise:\n            return [*lines, *self._decide(outcome.otherwise, indent, ended)]",
        PYTHON,
    ),
    Fault(
        "vicode/generators/python/expression_printer.py",
        "timers exclude their end",
        'return operator_chain([(None, passed), (">=", atom(f"{after.ns:_}"))], COMPARISON)',
        'return operator_chain([(None, passed), (">", atom(f"{after.ns:_}"))], COMPARISON)',
        PYTHON,
    ),
    Fault(
        "vicode/generators/python/expression_printer.py",
        "computed timers truncated",
        'call_expression("round", [product.breakable])',
        'call_expression("int", [product.breakable])',
        PYTHON,
    ),
    Fault(
        "vicode/generators/python/expression_printer.py",
        "functions of XABSL keep no arguments",
        "inside = replace(self, enclosing_calls=self.enclosing_calls | {function})",
        "inside = self",
        PYTHON,
    ),
    Fault(_HPP, "time is not continued", "            lag_ns_ += now_ns_ - now;\n", "", CPP),
    Fault(
        _HPP, "period truncated", "? 0 : nanoseconds(1e9 / hertz)", "? 0 : static_cast<Nanoseconds>(1e9 / hertz)", CPP
    ),
    Fault(
        _HPP,
        "period elapsed 1 ns late",
        "if (root.now_ns_ - worked_ns_ < period_ns_) {",
        "if (root.now_ns_ - worked_ns_ <= period_ns_ && period_ns_ != 0) {",
        CPP,
    ),
    Fault(_HPP, "calls repeated with old parameters", "call.modulate(*call.target, call.parameters.data());", "", CPP),
    Fault(
        _HPP,
        "a resumed component does not start",
        "return missed > 1 && (!resume || stepped_in_ == never_);",
        "return missed > 1 && !resume;",
        CPP,
    ),
    Fault(
        _HPP,
        "done for one iteration more",
        "return root.iteration_ - stepped_in_ <= 1; }",
        "return root.iteration_ - stepped_in_ <= 2; }",
        CPP,
    ),
    Fault(_HPP, "% gives 0.0", "return std::copysign(0.0, b);", "return 0.0;", CPP),
    Fault(_HPP, "round half up", "(rest == 0.5 && std::fmod(below, 2.0) != 0.0)", "rest == 0.5", CPP),
    Fault(_HPP, "state_time continues", "        entered_ns_ = root.now_ns_;\n    }", "    }", CPP),
    Fault(
        _HPP,
        "wait one iteration more",
        "waiting_iterations_ >= team_->ticks",
        "waiting_iterations_ > team_->ticks",
        CPP,
    ),
    Fault(
        _HPP,
        "restarted components of XABSL are done",
        "is_current ? restarted_in_ != root.iteration() : stepped_in_",
        "is_current ? true : stepped_in_",
        CPP,
    ),
    Fault(
        "vicode/generators/cpp/functions.py",
        "leave in the new state",
        _CPP_LEAVE,
        _CPP_LEAVE_LATE,
        CPP,
    ),
    Fault(
        "vicode/generators/cpp/functions.py",
        "enter after the new requires",
        '        if any(state.enter for state in plan.states):\n            body.append("    enter();")\n'
        '        if requires:\n            body.append("    require(required);")',
        '        if requires:\n            body.append("    require(required);")\n'
        '        if any(state.enter for state in plan.states):\n            body.append("    enter();")',
        CPP,
    ),
    Fault(
        "vicode/generators/cpp/functions.py",
        "common actions after those of the state",
        '        body = ["    act_common();"] if self.component.common_actions else []\n'
        "        body += self._switch(lambda state: self._steps(state.actions, 3 * INDENT))",
        "        body = self._switch(lambda state: self._steps(state.actions, 3 * INDENT))\n"
        '        body += ["    act_common();"] if self.component.common_actions else []',
        CPP,
    ),
    Fault(
        "vicode/generators/cpp/component.py",
        "old requires stepped again",
        'f"            if ((already & {bits[alias]}ULL) == 0) {{",',
        '"            if (true) {",',
        CPP,
    ),
    Fault(
        "vicode/generators/cpp/component.py",
        "calls kept at a restart",
        'body += ["    calls_.clear();"] if self._calls() else []',
        "body += []",
        CPP,
        "the period counts as elapsed at a restart, so that the work follows, which clears the calls first",
    ),
    Fault("vicode/generators/xabsl/options.py", "no target states", "is_target=plan.final", "is_target=False", XABSL),
    Fault(
        "vicode/generators/xabsl/decisions.py",
        "else of groups under their guard",
        "negation(conjunction(item.own))",
        "conjunction(item.own)",
        XABSL,
    ),
    Fault(
        "vicode/generators/xabsl/expression_builder.py",
        "component_time is state_time",
        'tree.KeywordNode("state_time" if of == "state" else "option_time")',
        'tree.KeywordNode("state_time")',
        XABSL,
    ),
    Fault(
        "vicode/generators/xabsl/expression_builder.py",
        "abs of negative numbers",
        'return conditional(_binary("<", first, _ZERO), _negative(first), first)',
        "return first",
        XABSL,
    ),
    Fault(
        "vicode/generators/xabsl/expression_builder.py",
        "timers exclude their end",
        'return _binary(">=", since, tree.NumberNode(format_decimal(ms)))',
        'return _binary(">", since, tree.NumberNode(format_decimal(ms)))',
        XABSL,
    ),
    Fault(
        "vicode/simulation/stubs.py",
        "a parameter resets the others",
        "modulate(**{**now, **new})",
        "modulate(**new)",
        ("simulator",),
    ),
    Fault(
        "vicode/simulation/stubs.py",
        "numbers keep the sign of zero no more",
        "if values[output.name] is not before[output.name]:",
        "if values[output.name] != before[output.name]:",
        ("simulator",),
    ),
    Fault(
        "vicode/simulation/host.py",
        "iterations have no time",
        "self._clock.advance(max(0, time_ns - self._clock.now_ns()))",
        "self._clock.advance(0)",
        ("simulator",),
    ),
    Fault(
        "vicode/simulation/stubs.py",
        "infinities become 0",
        "    try:\n        return make(value)",
        "    try:\n        return make(value) if abs(float(value)) < 1e300 else make(0)",
        ("simulator",),
    ),
)
