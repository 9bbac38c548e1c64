"""Verdicts about decisions, each as a person would reason."""

import pytest

from vicode.analysis import conditions
from vicode.analysis.guards import Basis, GuardAnalysis, Verdict, analyze_guards
from vicode.model.design import Code, DecisionGroup, Declaration, Design, Guard, State, Stay, Transition, Use
from vicode.model.project import WORLD, Enumeration, Interface, Project

_PARAMETERS = (
    Declaration(name="a", type="float", range=(0, 10)),
    Declaration(name="b", type="float", range=(0, 10)),
    Declaration(name="x", type="float"),
    Declaration(name="y", type="float"),
    Declaration(name="n", type="int", range=(0, 3)),
    Declaration(name="k", type="int"),
    Declaration(name="seen", type="bool"),
    Declaration(name="side", type="Side"),
)
_EYES = Interface(
    component="Eyes",
    implementation=WORLD,
    outputs=(
        Declaration(name="angle", type="float", range=(-180, 180)),
        Declaration(name="bearing", type="float", arguments=(Declaration(name="at", type="float"),)),
    ),
)


def judge(*guards: str | Guard, time_unit: str = "") -> list[tuple[int, Verdict, tuple[int, ...], Basis]]:
    """The verdicts about transitions with these guards: number, verdict, earlier ones, basis."""
    analysis = analyze(*guards, time_unit=time_unit)
    assert set(analysis.states) == {"A", "B"}
    return [
        (int(str(each.path[3])), each.verdict, tuple(int(str(path[3])) for path in each.earlier), each.basis)
        for each in analysis.find_verdicts()
    ]


def analyze(*guards: str | Guard, time_unit: str = "") -> GuardAnalysis:
    transitions = tuple(
        Transition(to="B", guard=each if isinstance(each, Guard) else Guard(when=each)) for each in guards
    )
    design = Design(
        component="Tested",
        time_unit=time_unit,
        uses=(Use(alias="eyes", component="Eyes"),),
        parameters=_PARAMETERS,
        initial="A",
        states=(State(name="A", transitions=transitions), State(name="B")),
    )
    project = Project(
        name="p",
        enumerations=(Enumeration(name="Side", elements=(("left", ""), ("right", ""), ("both", ""))),),
        constants=(
            Declaration(name="NEAR", initial="2.5"),
            Declaration(name="FAR", initial="NEAR * 2"),
            Declaration(name="TUNED", initial="3.0", tunable=True, range=(1, 5)),
        ),
        components=(_EYES,),
        designs=(design,),
    )
    return analyze_guards(project, design)


@pytest.mark.parametrize(
    "guard",
    [
        "a < 3 and a > 4",
        "a < 3 and a >= 3",
        "a != a and seen and a == 4",
        "seen and not seen",
        "side == Side.left and side == Side.right",
        "side != Side.left and side != Side.right and side != Side.both",
        "n > 1 and n < 2",
        "k > 1.2 and k < 1.9",
        "not (k < 2 or k > 1)",
        "abs(eyes.angle) > 40 and eyes.angle < 30 and eyes.angle > -30",
        "-x > 4 and x > -4",
        "min(x, y) > 4 and y < 4",
        "max(x, y) < 4 and y > 4",
        "clamp(x, 0, 1) > 1.5",
        "sign(x) == 1 and x < 0",
        "x < y and x > y",
        "x < y and y <= x",
        "x == y and x < y",
        "a > 5 and b > 5 and a + b < 9",
        "2 * a > 8 and a < 3.5",
        "a / 2 > 4 and a < 7",
        "floor(a) > 6 and a < 6.5",
        "sin(x) > 1.1",
        "x + y > 3 and x + y < 2",
        "eyes.bearing(at=x) > 3 and eyes.bearing(at=x) < 2",
        "a < b < a",
        "(a if seen else b) > 4 and a < 4 and b < 4",
        "state_time > 3 and state_time < 3",
        "FAR < 4",
        "a < NEAR and a > FAR",
        "k + 1 > 4 and k < 3",
        "team_size < 1",
        "state_time < 0",
    ],
)
def test_a_guard_that_contradicts_itself_never_holds(guard: str) -> None:
    assert [each[:2] for each in judge(guard)] == [(0, Verdict.NEVER_HOLDS)]


@pytest.mark.parametrize(
    "guard",
    [
        "a < 3 and a > 2",
        "not (x < 3 or x >= 3)",
        "x != x",
        "x + y != x + y",
        "is_nan(x)",
        "n > 1 and n < 3",
        "k > 1 and k < 2.5",
        "abs(eyes.angle) > 40 and eyes.angle < -30",
        "min(x, y) > 4 and x > 5",
        "x < y and x < 0",
        "a > 5 and b > 4 and a + b <= 9.5",
        "eyes.bearing(at=x) > 3 and eyes.bearing(at=y) < 2",
        "state_time >= 3 and state_time <= 3",
        "a < TUNED and a > 4",
        "k + 1 > 4 and k < 5",
        "x - y > 0 and x < y + 1e-300",
        "0.1 + x > 0.3 and x <= 0.2",
        "x * 0 != 0",
        "x / y > 3 and x < 1",
        "x % 3 > 2",
        "team_size > 4",
        "eyes.angle == 180",
    ],
)
def test_a_guard_that_can_hold_is_left_alone(guard: str) -> None:
    assert judge(guard) == []


def test_a_range_on_which_a_proof_rests_is_named() -> None:
    assert judge("a > 20") == [(0, Verdict.NEVER_HOLDS, (), Basis(facts=("a from 0 to 10",)))]
    assert judge("a > 20 and a < 15") == [(0, Verdict.NEVER_HOLDS, (), Basis())]
    assert judge("not max(a, b) >= 0") == [(0, Verdict.NEVER_HOLDS, (), Basis(facts=("a from 0 to 10",)))]
    assert judge("n + 1 > b + 20") == [(0, Verdict.NEVER_HOLDS, (), Basis(facts=("b from 0 to 10", "n from 0 to 3")))]


def test_a_constant_on_which_a_proof_rests_is_named() -> None:
    assert judge("x > NEAR and x < 2") == [(0, Verdict.NEVER_HOLDS, (), Basis(facts=("NEAR is 2.5",)))]
    assert judge("x > NEAR and seen and x < NEAR and not seen") == [(0, Verdict.NEVER_HOLDS, (), Basis())]
    shadowed = judge("x > NEAR", "x > FAR")
    assert shadowed == [(1, Verdict.SHADOWED, (0,), Basis(facts=("NEAR is 2.5", "FAR is 5.0")))]


def test_earlier_decisions_that_shadow_one_are_named() -> None:
    assert judge("a > 5", "seen", "a > 7")[0][:3] == (2, Verdict.SHADOWED, (0,))
    assert judge("n < 1", "seen", "n > 1", "n == 1", "not seen")[0][:3] == (4, Verdict.NEVER_TESTED, (0, 2, 3))


def test_the_order_of_timers_counts() -> None:
    verdicts = judge(Guard(after="3"), Guard(after="5"))
    assert [each[:3] for each in verdicts] == [(1, Verdict.SHADOWED, (0,))]
    assert judge(Guard(after="5"), Guard(after="3")) == []
    assert [each[0] for each in judge(Guard(after="3"), "state_time >= 3.5")] == [1]
    assert judge(Guard(after="3", when="seen"), Guard(after="5")) == []
    assert [each[0] for each in judge(Guard(after="300"), "state_time >= 301", time_unit="ms")] == [1]
    assert judge(Guard(after="TUNED"), Guard(after="4")) == []
    assert [each[0] for each in judge(Guard(after="TUNED"), Guard(after="5"))] == [1]


def test_a_time_is_compared_as_the_generated_code_divides_it() -> None:
    # 0.3 s are 300,000,000 ns, which divided by 1e9 give 0.3.
    assert [each[0] for each in judge(Guard(after="0.3"), "state_time >= 0.3")] == [1]
    assert [each[0] for each in judge("state_time >= 0.3", Guard(after="0.3"))] == [1]
    assert judge("state_time > 0.3", Guard(after="0.3")) == []


def test_nan_is_named_where_it_would_change_the_verdict() -> None:
    verdicts = judge("x < 3", "x >= 3", "seen")
    assert verdicts == [(2, Verdict.NEVER_TESTED, (0, 1), Basis(no_nan=True))]
    verdicts = judge("a < 3", "a >= 3", "seen")
    assert verdicts == [(2, Verdict.NEVER_TESTED, (0, 1), Basis(facts=("a from 0 to 10",)))]
    assert judge("x < 3", "x >= 3", "x != x", "seen")[0][:3] == (3, Verdict.NEVER_TESTED, (0, 1, 2))
    assert judge("x < 3", "x >= 3", "is_nan(x)") == []


def test_code_can_be_anything_each_time() -> None:
    code = Guard(code=Code(texts=(("python", "return self.x > 3"),)))
    assert judge(code, code) == []


def test_decisions_of_groups_are_judged_within_them() -> None:
    low = DecisionGroup(
        guard=Guard(when="a < 3"),
        then=(Transition(to="B", guard=Guard(when="a > 4")), Stay(guard=Guard(when="a < 4")), Transition(to="B")),
        otherwise=(Transition(to="B", guard=Guard(when="a >= 1")),),
    )
    design = Design(
        component="Tested",
        parameters=_PARAMETERS,
        initial="A",
        states=(State(name="A", transitions=(low, Transition(to="B"))), State(name="B")),
    )
    found = analyze_guards(Project(name="p", designs=(design,)), design).find_verdicts()
    assert [(each.path[3:], each.verdict) for each in found] == [
        ((0, "then", 0), Verdict.NEVER_HOLDS),
        ((0, "then", 1), Verdict.ALWAYS_HOLDS),
        ((0, "then", 2), Verdict.NEVER_TESTED),
        ((0, "else", 0), Verdict.ALWAYS_HOLDS),
        ((1,), Verdict.NEVER_TESTED),
    ]


def test_what_is_too_large_has_no_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    guards = ("a + b > 5 and n > 1", "x < y and seen", "a + b > 5 and n > 2", "x < y and seen and k > 3", "a > 11")
    numbers_found = set()
    for limit in range(3, 150):
        monkeypatch.setattr(conditions, "_MAX_NODES", limit)
        numbers_found.add(tuple(each.path[3] for each in analyze(*guards).find_verdicts()))
    assert {(), (2, 3, 4)} < numbers_found
    assert all({*numbers} <= {2, 3, 4} for numbers in numbers_found)


def test_each_state_may_add_as_many_nodes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(conditions, "_NODES_OF_A_QUESTION", 40)
    pairs = tuple((f"x > {number} and y > {number}", f"x > {number + 1} and y > {number + 1}") for number in range(40))
    states = tuple(
        State(name=f"S{number}", transitions=tuple(Transition(to="S0", guard=Guard(when=each)) for each in pair))
        for number, pair in enumerate(pairs)
    )
    design = Design(component="Tested", parameters=_PARAMETERS, initial="S0", states=states)
    found = list(analyze_guards(Project(name="p", designs=(design,)), design).find_verdicts())
    assert [each.path[1] for each in found] == [state.name for state in states]


def test_a_value_minus_or_divided_by_itself_is_known() -> None:
    assert judge("a - a > 0") == [(0, Verdict.NEVER_HOLDS, (), Basis())]
    assert [each[1] for each in judge("k - k != 0")] == [Verdict.NEVER_HOLDS]
    assert [each[1] for each in judge("(a + 1) / (a + 1) > 1")] == [Verdict.NEVER_HOLDS]
    assert judge("not x - x == 0") == []
    assert judge("not a / a == 1") == []
