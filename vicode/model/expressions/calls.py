"""Binding of calls: done(x), built-in functions, outputs with arguments."""

import ast
from typing import TYPE_CHECKING

from vicode.findings import did_you_mean
from vicode.model.design import Declaration
from vicode.model.expressions.functions import FUNCTIONS, NUMBER, BuiltinFunction
from vicode.model.expressions.tree import BOOL, FLOAT, INT, UNKNOWN, Done, Expr, FunctionCall, Logic, Not, OutputRef

if TYPE_CHECKING:
    from vicode.model.expressions.binder import ExpressionBinder


class CallBinder:
    """Binds calls for an `ExpressionBinder`."""

    def __init__(self, binder: "ExpressionBinder") -> None:
        self.binder = binder

    def bind(self, syntax: ast.Call) -> Expr | None:
        """Return the node of a call, None after an error."""
        match syntax.func:
            case ast.Name(id="done" | "failed" as name):
                return self._bind_end(name, syntax)
            case ast.Name(id=name) if name in FUNCTIONS:
                return self._bind_function_call(FUNCTIONS[name], syntax)
            case ast.Name(id=name):
                fix = did_you_mean(
                    name, [*FUNCTIONS, "done", "failed"], "use a built-in function or a 'code' predicate"
                )
                self.binder.report("E303", f"unknown function '{name}'", fix, syntax.func)
            case ast.Attribute(value=ast.Name(id=alias), attr=name) if alias in self.binder.scope.uses:
                return self._bind_output_call(alias, name, syntax)
            case ast.Attribute(value=ast.Name(id=alias)):
                fix = did_you_mean(alias, self.binder.scope.uses, "declare it in 'uses'")
                self.binder.report("E303", f"'{alias}' is not a used component", fix, syntax.func)
            case _:
                self.binder.report("E302", "only functions and outputs can be called", "", syntax)
        return None

    def _bind_end(self, name: str, syntax: ast.Call) -> Expr | None:
        """Bind done(x) or failed(x)."""
        match syntax.args:
            case [ast.Name(id=alias)] if alias in self.binder.scope.uses and not syntax.keywords:
                return self._end_of(alias, name, syntax)
            case [ast.Name(id=alias) as argument]:
                fix = did_you_mean(alias, self.binder.scope.uses, "declare it in 'uses'")
                self.binder.report("E303", f"'{alias}' is not a used component", fix, argument)
            case _:
                message = f"{name} takes one argument, the alias of a used component"
                self.binder.report("E305", message, f"use {name}(alias)", syntax)
        return None

    def _end_of(self, alias: str, name: str, syntax: ast.Call) -> Expr | None:
        """Whether a component is in a final state, and its derived output tells that it is a failed one or not."""
        span, interface = self.binder.get_span(syntax), self.binder.scope.uses[alias]
        done = Done(alias=alias, span=span)
        if interface is None or any(each.origin for each in interface.outputs):
            failed = OutputRef(alias=alias, output="failed", type=BOOL, span=span)
            test = failed if name == "failed" else Not(operand=failed, span=span)
            return done if interface is None else Logic(operator="and", operands=(done, test), span=span)
        if name == "failed":
            fix = f"add 'failed: true' to a state of {interface.component}, or use done"
            self.binder.report("E303", f"'{interface.component}' has no failed state", fix, syntax)
            return None
        return done

    def _bind_function_call(self, function: BuiltinFunction, syntax: ast.Call) -> Expr | None:
        arguments = [self.binder.bind(argument) for argument in syntax.args]
        bound = tuple(argument for argument in arguments if argument is not None)
        count = len(function.parameter_types)
        if syntax.keywords or len(arguments) < count or (len(arguments) > count and not function.is_variadic):
            wanted = f"{count} or more" if function.is_variadic else str(count)
            message = f"{function.name} takes {wanted} argument{'s' * (count != 1)}"
            self.binder.report("E305", message, f"{function.name}: {function.doc}", syntax)
            return None
        if len(bound) < len(arguments):
            return None
        for argument in bound:
            self.binder.require_number(argument)
        type_ = function.return_type
        if type_ == NUMBER:
            type_ = INT if all(argument.type == INT for argument in bound) else FLOAT
        return FunctionCall(function=function.name, arguments=bound, type=type_, span=self.binder.get_span(syntax))

    def _bind_output_call(self, alias: str, name: str, syntax: ast.Call) -> Expr | None:
        interface = self.binder.scope.uses[alias]
        span = self.binder.get_span(syntax)
        if interface is None:
            return OutputRef(alias=alias, output=name, arguments=(), type=UNKNOWN, span=span)
        output = interface.output(name)
        if output is None:
            fix = did_you_mean(
                name, (output.name for output in interface.readable), f"declare it in {interface.component}"
            )
            self.binder.report("E303", f"'{interface.component}' has no output '{name}'", fix, syntax.func)
            return None
        if output.arguments is None:
            self.binder.report("E305", f"'{alias}.{name}' takes no arguments", f"use {alias}.{name}", syntax)
            return None
        pairs = self._bind_arguments(output, output.arguments, syntax)
        if pairs is None:
            return None
        type_ = self.binder.scope.type_of(output)
        return OutputRef(alias=alias, output=name, arguments=pairs, type=type_, span=span)

    def _bind_arguments(
        self, output: Declaration, declared: tuple[Declaration, ...], syntax: ast.Call
    ) -> tuple[tuple[str, Expr], ...] | None:
        """Bind the arguments to the declared names, in source order."""
        by_name = {argument.name: argument for argument in declared}
        names = [argument.name for argument in declared]
        if len(syntax.args) > len(names):
            self.binder.report("E305", f"'{output.name}' takes {len(names)} arguments", "remove the others", syntax)
            return None
        given = [
            *zip(names, syntax.args, strict=False),
            *((keyword.arg or "", keyword.value) for keyword in syntax.keywords),
        ]
        pairs: list[tuple[str, Expr]] = []
        for name, value in given:
            if name not in by_name or name in dict(pairs):
                problem = "is passed twice" if name in by_name else f"is not an argument of '{output.name}'"
                self.binder.report("E305", f"'{name}' {problem}", did_you_mean(name, names), value)
                return None
            node = self.binder.bind_expected(value, self.binder.scope.type_of(by_name[name]))
            if node is None:
                return None
            pairs.append((name, node))
        return self._check_required_arguments(output, declared, pairs, syntax)

    def _check_required_arguments(
        self,
        output: Declaration,
        declared: tuple[Declaration, ...],
        pairs: list[tuple[str, Expr]],
        syntax: ast.Call,
    ) -> tuple[tuple[str, Expr], ...] | None:
        missing = [argument.name for argument in declared if not argument.initial and argument.name not in dict(pairs)]
        if missing:
            self.binder.report("E305", f"'{output.name}' requires {', '.join(missing)}", f"add {missing[0]}=…", syntax)
            return None
        return tuple(pairs)
