"""The page of the semantics names the functions of the interpreter, and the cases show what each of them does."""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import vicode.semantics
from tests.conformance.conformance_cases import CASES, Case
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.reference import run_reference
from vicode.conformance.traces import TraceIteration
from vicode.semantics import NotInterpretableError

PAGE = Path(__file__).parents[2] / "docs" / "semantics.md"
MODULES = {
    each.name: importlib.import_module(f"vicode.semantics.{each.name}")
    for each in pkgutil.iter_modules(vicode.semantics.__path__)
}


def table() -> dict[str, list[str]]:
    """The functions by rule."""
    section = PAGE.read_text(encoding="utf-8").partition("## The reference interpreter")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (.*) \| (`.*`) \|$", section, re.MULTILINE)
    return {rule: re.findall(r"`([\w.]+)`", functions) for rule, functions in rows}


NO_RULE = "no rule: what `vicode conform` and `vicode test` need"
NAMED = [name for rule, names in table().items() if rule != NO_RULE for name in names]


def public_functions() -> Iterator[str]:
    for module_name, module in MODULES.items():
        for name, value in vars(module).items():
            if getattr(value, "__module__", "") != module.__name__ or name.startswith("_"):
                continue
            if inspect.isfunction(value):
                yield f"{module_name}.{name}"
            elif inspect.isclass(value) and not getattr(value, "_is_protocol", False):
                yield from (
                    f"{module_name}.{name}.{each}"
                    for each, member in vars(value).items()
                    if not each.startswith("_") and (inspect.isfunction(member) or isinstance(member, property))
                )


def test_each_public_function_is_named_once() -> None:
    names = [name for functions in table().values() for name in functions]
    assert len(names) == len(set(names))
    assert set(public_functions()) - set(names) == set()


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[ConformanceRun, list[TraceIteration]]]:
    runs = [Case(file, tmp_path_factory.mktemp("case")).run for file in sorted(CASES.glob("*.yaml"))]
    return [(run, run_reference(run)) for run in runs]


@pytest.mark.parametrize("name", NAMED)
def test_a_case_shows_what_a_function_does(
    name: str, cases: list[tuple[ConformanceRun, list[TraceIteration]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    break_function(name, monkeypatch)
    assert any(is_noticed(run, expected) for run, expected in cases)


def is_noticed(run: ConformanceRun, expected: list[TraceIteration]) -> bool:
    try:
        return run_reference(run) != expected
    except Exception:
        return True


def break_function(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Change what a function returns; one without a result does nothing."""
    module_name, *owners, last = name.split(".")
    module = MODULES[module_name]
    owner: Any = module
    for each in owners:
        owner = getattr(owner, each)
    member = inspect.getattr_static(owner, last)
    if isinstance(member, property):
        assert member.fget is not None
        monkeypatch.setattr(owner, last, property(broken(member.fget)))
        return
    replacement = broken(member)
    if owners:
        monkeypatch.setattr(owner, last, replacement)
        return
    # Other modules and tables refer to it.
    for each in MODULES.values():
        for key, value in list(vars(each).items()):
            if value is member:
                monkeypatch.setattr(each, key, replacement)
            elif isinstance(value, dict):
                break_entries(value, member, monkeypatch)


def break_entries(functions: dict[str, Any], member: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Change a function of a table, or those that it has made."""
    made = f"{member.__name__}.<locals>."
    for key, function in list(functions.items()):
        if function is member or getattr(function, "__qualname__", "").startswith(made):
            monkeypatch.setitem(functions, key, broken(function))


def broken(function: Callable[..., Any]) -> Callable[..., Any]:
    def call(*arguments: Any, **named: Any) -> Any:
        if inspect.signature(function).return_annotation in ("None", None):
            return None
        return changed(function(*arguments, **named))

    return call


def changed(result: Any) -> Any:
    match result:
        case bool():
            return not result
        case int() | float():
            return result + 1
        case None:
            return False
        case _:
            raise NotInterpretableError("broken")
