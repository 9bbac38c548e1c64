"""Generated components behave as docs/semantics.md specifies."""

import math

from tests.generators.run_harness import StartHarness, play

__all__ = ["play"]

TWO = """
component: Two
frequency: {frequency}
uses: {{eyes: Eyes, legs: Legs}}
initial: A
states:
  A:
    requires: [eyes]
    enter: self.world.log.append("enter A")
    leave: self.world.log.append("leave A " + self.state)
    actions: [{{call: legs, with: {{speed: 1}}}}]
    transitions: [{{to: B, when: eyes.seen, id: sees}}]
  B:
    requires: [eyes, legs]
    enter: self.world.log.append("enter B " + self.state)
    actions: self.world.log.append("act B")
    transitions: [{{to: A, after: patience}}]
"""


def test_order_of_enter_requires_decision_and_actions(play: StartHarness) -> None:
    two = play(TWO.format(frequency=1000))
    assert two.tick() == ["enter A", "eyes", "legs restart", "legs 1 8"]
    assert two.tick() == ["eyes", "legs 1 8"]
    assert two.tick(seen=True) == ["eyes", "leave A A", "enter B B", "legs 1 8", "act B"]
    assert two.tick() == ["eyes", "legs 1 8", "act B"]


def test_times_are_exact_to_the_nanosecond(play: StartHarness) -> None:
    two = play(TWO.format(frequency=1000))
    two.tick(seen=True)
    assert two.main.state == "B"
    two.tick(499)
    two.clock.advance(999_999)
    two.tick(0)
    assert two.main.state == "B"
    two.clock.advance(1)
    two.tick(0)
    assert two.main.state == "A"


def test_between_periods_only_requirements_and_calls_are_stepped(play: StartHarness) -> None:
    two = play(TWO.format(frequency=2))
    two.tick()
    assert two.tick(100, seen=True) == ["eyes", "legs 1 8"]
    assert two.main.state == "A"
    assert two.tick(400)[:2] == ["eyes", "leave A A"]


CALLER = """
component: Caller
uses: {eyes: Eyes, two: Two}
initial: On
states:
  On: {requires: [eyes], modulates: [two], transitions: [{to: Off, when: eyes.distance > 0}]}
  Off: {requires: [eyes], transitions: [{to: On, when: eyes.distance == 0}]}
"""


def test_paused_component_restarts(play: StartHarness) -> None:
    caller = play(CALLER, TWO.format(frequency=1000))
    caller.tick(seen=True)
    assert caller.main.two.state == "B"
    caller.tick(distance=1.0)
    log = caller.tick(distance=0.0, seen=False)
    assert "enter A" in log
    assert "leave B" not in log
    assert caller.main.two.state == "A"


def test_resuming_component_continues(play: StartHarness) -> None:
    caller = play(CALLER, "resume: true\n" + TWO.format(frequency=1000))
    caller.tick(seen=True)
    caller.tick(distance=1.0)
    assert "enter A" not in caller.tick(distance=0.0, seen=False)
    assert caller.main.two.state == "B"


TREE = """
component: Tree
variables: {x: 0}
initial: S
common:
  actions: [{set: {x: x + 100}}]
  transitions: [{to: C, when: x == 1}, {stay: true, when: x == 2}]
states:
  S:
    transitions:
      - {to: D, when: x == 2}
      - when: x >= 10 and x < 20
        then: [{to: A, when: x == 10}, {stay: true, when: x == 11}]
        else: [{to: B, when: x == 20}]
      - {to: C, when: x == 11 or x == 12 or x == 21}
      - {to: S, when: x == 30}
      - {to: D, when: x == 30}
      - to: D
        code: |
          return self.x == 40
  A: {}
  B: {}
  C: {}
  D: {final: true}
"""


def test_decision_trees_fall_through_and_stay(play: StartHarness) -> None:
    expected = {1: "C", 2: "S", 10: "A", 11: "S", 12: "C", 20: "B", 21: "C", 30: "S", 40: "D", 50: "S"}
    for x, state in expected.items():
        tree = play(TREE)
        tree.tick()
        tree.main.x = x
        tree.tick()
        assert (tree.main.state, tree.main.x) == (state, x + 100), x


VALUES = """
component: Values
uses: {eyes: Eyes, legs: Legs}
parameters: {side: Side.right, speed: {type: float, default: 3}}
outputs: {a: 0.0, n: 0, yes: false, where: Side.left}
initial: S
states:
  S:
    requires: [eyes]
    modulates: {legs: {turn: "-speed"}}
    actions:
      - set: {a: 1 / zero, n: n + 1, yes: side == Side.right, where: side}
    leave: [{set: {a: 2}}]
    transitions: [{to: T, when: eyes.seen}]
  T:
    requires: [eyes]
    enter: [{set: {n: 10}}, {set: {n: n + 1}}, {code: self.n *= 2}]
    actions: [{set: {a: "eyes.twice(4, plus=n % 5)"}}]
"""


def test_values_have_their_declared_types(play: StartHarness) -> None:
    values = play(VALUES)
    assert (values.main.speed, type(values.main.speed)) == (3.0, float)
    assert values.tick()[-1] == "legs 7 -3"
    main = values.main
    assert (main.a, main.n, main.yes, main.where) == (math.inf, 1, True, main.side)
    values.tick(seen=True)
    assert (main.n, main.a) == (22, 10.0)


READING = """
component: Reading
uses: {gauge: Gauge}
outputs: {x: 0.0, where: Side.left}
initial: S
states:
  S:
    transitions: [{to: T, when: gauge.ready and gauge.level > 1}]
    actions: [{set: {x: x + 1}}]
  T:
    enter: self.world.level += 1
    actions: [{set: {x: gauge.level, where: gauge.where}}]
"""


def test_inputs_of_the_world_are_read_and_converted_where_they_are_mentioned(play: StartHarness) -> None:
    reading = play(READING)
    reading.tick(ready=0)
    assert (reading.errors, reading.main.x) == ([], 1.0)
    reading.tick(ready=1, level=None)
    assert [(error.component, error.state, error.body) for error in reading.errors] == [("Reading", "S", "state")]
    reading.tick(level=2, where="right")
    assert (reading.main.state, reading.main.x, type(reading.main.x)) == ("T", 3.0, float)
    assert reading.main.where is type(reading.main.where).right


NESTED = """
component: Nested
uses: {last: Last}
outputs: {count: 0}
initial: Work
states:
  Work: {modulates: [last], transitions: [{to: Rest, when: done(last)}]}
  Rest: {actions: [{set: {count: count + 1}}]}
"""
LAST = """
component: Last
initial: One
states:
  One: {transitions: [{to: Two, after: 0.2}]}
  Two: {final: true}
"""


def test_caller_sees_final_state(play: StartHarness) -> None:
    nested = play(NESTED, LAST)
    states = []
    for _ in range(5):
        nested.tick()
        states.append(nested.main.state)
    assert states == ["Work", "Work", "Work", "Rest", "Rest"]


FAILING = """
component: Failing
outputs: {n: 0}
initial: S
states:
  S:
    actions:
      - set: {n: n + 1}
      - code: |
          if self.n == 2:
              raise ValueError("two")
      - set: {n: n + 10}
"""


def test_exception_is_reported_with_its_location_and_execution_continues(play: StartHarness) -> None:
    failing = play(FAILING)
    failing.main.n = 1
    failing.tick()
    (error,) = failing.errors
    assert (error.component, error.design_file, error.state) == ("Failing", "design0.yaml", "S")
    assert "S.actions" in str(error)
    assert "ValueError: two" in str(error)
    assert failing.main.n == 2
    failing.tick()
    assert (failing.main.n, len(failing.errors)) == (13, 1)


MILLISECONDS = """
component: Milliseconds
time_unit: ms
initial: A
states:
  A: {transitions: [{to: B, when: state_time >= 300}]}
  B: {transitions: [{to: C, after: 200}]}
  C: {final: true}
"""


def test_time_unit_may_be_milliseconds(play: StartHarness) -> None:
    component = play(MILLISECONDS)
    states = []
    for _ in range(6):
        component.tick(100)
        states.append(component.main.state)
    assert states == ["A", "A", "A", "B", "B", "C"]


ARM = """
component: Armed
uses: {arm: Arm}
initial: Rest
states:
  Rest: {modulates: [arm], transitions: [{to: Lift, after: 1}]}
  Lift: {modulates: {arm: {lift: 2, side: Side.right}}}
"""


def test_hand_written_components_get_the_declared_defaults(play: StartHarness) -> None:
    armed = play(ARM)
    assert armed.tick() == ["arm 2.0 False left 7"]
    assert armed.tick(1000) == ["arm 2.0 False right 2"]
    assert armed.errors == []


SENSED = """
component: Sensed
uses: {sensors: Sensors, arm: Arm}
initial: Rest
states:
  Rest:
    modulates: {sensors: {power: 4}}
    transitions:
      - {to: Near, when: sensors.near(1)}
      - {to: Lift, when: sensors.order_given and sensors.side == Side.right}
  Near: {final: true}
  Lift: {modulates: {arm: {reach: 1}}}
"""


def test_the_robot_program_sets_outputs_that_have_no_implementation(play: StartHarness) -> None:
    sensed = play(SENSED)
    sensed.tick()
    assert (sensed.main.state, sensed.errors) == ("Rest", [])
    sensors = sensed.main.sensors
    assert (sensors.order_given, sensors.power) == (False, 4)
    sensors.order_given, sensors.side = True, sensors.side.__class__.right
    sensed.tick()
    assert (sensed.main.state, sensed.errors) == ("Lift", [])
