"""People have names and colours; a company knows what each window is at; keystrokes of two people come together."""

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import DISK, Company, People, Presence
from vicode.editor.session.keystrokes import Keystrokes
from vicode.editor.session.wording import words_of_path, words_of_presence, words_of_value
from vicode.editor.view import Selected
from vicode.model.design import Transition


def test_people_are_guests_until_they_choose_a_name() -> None:
    people = People()
    first, second = people.greet("1"), people.greet("2", "  Ana\n<b>  ")
    assert (first.name, second.name) == ("Guest 1", "Ana <b>")
    assert first.colour != second.colour
    assert people.greet("1", "Ben") == people.greet("1")
    assert len(people.greet("3", "x" * 99).name) == 24
    assert people.greet("2", "\x07").name == "Ana <b>"
    assert people.name_of("1") == "Ben"
    assert people.name_of(DISK) == "another program"
    assert people.name_of("nobody") == "somebody"


def test_a_company_knows_who_is_here_and_tells_changes() -> None:
    people, company = People(), Company()
    heard: list[int] = []
    unwatch = company.watch(lambda: heard.append(len(company.all)))
    company.enter("a", people.greet("1", "Ana"))
    company.enter("b", people.greet("2", "Ben"))
    company.turn("b", selected=(Selected(of="states", id="Kick"),))
    company.turn("b", selected=(Selected(of="states", id="Kick"),))
    company.turn("gone", pointer=(1.0, 2.0))
    assert heard == [1, 2, 2]
    assert [words_of_presence(each) for each in company.others("a")] == ["state Kick"]
    company.turn("b", typing_in=("states", "Kick", "doc"))
    assert company.typing_at(("states", "Kick", "doc"), "a") == ("Ben",)
    assert company.typing_at(("states", "Kick", "doc"), "b") == ()
    assert [words_of_presence(each) for each in company.others("a")] == ["types doc of state Kick"]
    company.leave("b")
    assert company.others("a") == ()
    unwatch()
    company.leave("a")
    assert heard[-1] == 1


def test_paths_and_values_are_said_in_words() -> None:
    assert words_of_path(()) == "the design"
    assert words_of_path(("doc",)) == "doc of the design"
    assert words_of_path(("variables", "n", "type")) == "type of variable n"
    assert words_of_path(("states", "Kick", "transitions", 1, "when")) == "transition 2 of state Kick, when"
    assert words_of_path(("common", "transitions", 0)) == "transition 1 of the common ones"
    assert words_of_value(None) == "(removed)"
    assert words_of_value("") == "(empty)"
    assert words_of_value((10.0, 20.5)) == "10, 20.5"
    assert words_of_value(Transition(to="Kick", doc="now")) == "to: Kick\ndoc: now"
    presence = Presence(window="a", person=People().greet("1"), selected=(Selected(of="transitions", id="Kick/0"),))
    assert words_of_presence(presence) == "transition 1 of state Kick"


def test_what_is_typed_meets_what_others_typed() -> None:
    keys = Keystrokes()
    keys.show("ball")
    assert keys.bring_in("the ball", "ball") == "the ball"
    keys.sent("the ball", "the ball")
    assert keys.bring_in("the red ball", "the ball rolls") == "the red ball rolls"
    keys.sent("the red ball", "the red ball")
    # What they typed stays in the design, though it is not shown to who types on.
    assert keys.bring_in("the red ball!", "the red ball rolls") == "the red ball! rolls"
    keys.sent("the red ball!", "the red ball!")
    assert keys.bring_in("the red ball!!", "the red ball!") == "the red ball!!"


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 12), st.integers(0, 3)), max_size=20))
def test_whoever_types_and_rests_no_keystroke_is_lost(presses: list[tuple[bool, int, int]]) -> None:
    """Each press: who, where, and how many letters come before the next is sent."""
    design, shown, keys, left = "ball", ["ball", "ball"], [Keystrokes(), Keystrokes()], ["ABCDEFGH" * 8, "01234567" * 8]
    typed = ["", ""]
    for each in keys:
        each.show(design)
    for who, where, count in [*presses, (False, 0, 1), (True, 0, 1)]:
        letters, left[who] = left[who][:count], left[who][count:]
        typed[who] += letters
        at = min(where, len(shown[who]))
        shown[who] = shown[who][:at] + letters + shown[who][at:]
        design = keys[who].bring_in(shown[who], design)
        keys[who].sent(shown[who], shown[who])
    assert sorted(design) == sorted("ball" + "".join(typed))


def test_a_spelling_of_the_design_is_nobodys_change() -> None:
    keys = Keystrokes()
    keys.show("")
    keys.sent("x=1\ny", "x = 1\ny = ")
    assert keys.bring_in("x=1\ny=2", "x = 1\ny = ") == "x=1\ny=2"
    assert keys.bring_in("x=1\ny=2", "x = 1\nz = 3\ny = ").replace(" ", "") == "x=1\nz=3\ny=2"


def test_choices_of_two_people_come_together() -> None:
    keys = Keystrokes()
    keys.show(["a", "b"])
    assert keys.bring_in(["a", "c"], ["a", "b", "d"]) == ["a", "d", "c"]
    keys.sent(["a", "c"], ["a", "c"])
    assert keys.bring_in(["a", "c", "e"], ["a", "d", "c"]) == ["a", "d", "c", "e"]
    assert keys.bring_in(True, False) is True
