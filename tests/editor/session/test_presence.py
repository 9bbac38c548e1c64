"""Users and presences."""

from vicode.editor.session import DISK_USER, Presence, PresenceRoom, UserDirectory
from vicode.editor.session.descriptions import describe_presence, describe_value
from vicode.editor.view import ItemRef
from vicode.model.design import Transition
from vicode.model.paths import describe_path


def test_users_are_guests_until_they_choose_a_name() -> None:
    users = UserDirectory()
    first, second = users.get_or_create_user("1"), users.get_or_create_user("2", "  Ana\n<b>  ")
    assert (first.name, second.name) == ("Guest 1", "Ana <b>")
    assert first.color != second.color
    assert users.get_or_create_user("1", "Ben") == users.get_or_create_user("1")
    assert len(users.get_or_create_user("3", "x" * 99).name) == 24
    assert users.get_or_create_user("2", "\x07").name == "Ana <b>"
    assert users.name_of("1") == "Ben"
    assert users.name_of(DISK_USER) == "another program"
    assert users.name_of("nobody") == "someone"


def test_two_guests_have_two_names() -> None:
    users = UserDirectory()
    for id_, name in (("1", ""), ("2", "Guest 3"), ("3", "")):
        users.get_or_create_user(id_, name)
    users.get_or_create_user("1", "Ada")
    users.get_or_create_user("4")
    names = [users.name_of(id_) for id_ in "1234"]
    assert names == ["Ada", "Guest 3", "Guest 2", "Guest 1"]
    for number in range(1200):
        users.get_or_create_user(f"many {number}")
    recent = [users.name_of(f"many {number}") for number in range(300, 1200)]
    assert len(set(recent)) == len(recent)


def test_presences_are_listed_and_changes_are_notified() -> None:
    users, room = UserDirectory(), PresenceRoom()
    counts: list[int] = []
    unsubscribe = room.changes.subscribe(lambda: counts.append(len(room.presences)))
    room.join("a", users.get_or_create_user("1", "Ana"))
    room.join("b", users.get_or_create_user("2", "Ben"))
    room.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    room.update("b", selected=(ItemRef(kind="states", id="Kick"),))
    room.update("closed", pointer=(1.0, 2.0))
    assert counts == [1, 2, 2]
    assert [describe_presence(other) for other in room.others("a")] == ["state Kick"]
    room.update("b", editing_path=("states", "Kick", "doc"))
    assert room.names_editing(("states", "Kick", "doc"), "a") == ("Ben",)
    assert room.names_editing(("states", "Kick", "doc"), "b") == ()
    assert [describe_presence(other) for other in room.others("a")] == ["edits description of state Kick"]
    room.leave("b")
    assert room.others("a") == ()
    unsubscribe()
    room.leave("a")
    assert counts[-1] == 1


def test_paths_and_values_are_described() -> None:
    assert describe_path(()) == "the design"
    assert describe_path(("doc",)) == "description of the design"
    assert describe_path(("variables", "n", "type")) == "type of variable n"
    assert describe_path(("states", "Kick", "transitions", 1, "when")) == "transition 2 of state Kick, when"
    assert describe_path(("common", "transitions", 0)) == "transition 1 of the common section"
    assert describe_value(None) == "(removed)"
    assert describe_value("") == "(empty)"
    assert describe_value((10.0, 20.5)) == "10, 20.5"
    assert describe_value(Transition(to="Kick", doc="now")) == "to: Kick\ndoc: now"
    presence = Presence(
        window="a", user=UserDirectory().get_or_create_user("1"), selected=(ItemRef(kind="transitions", id="Kick/0"),)
    )
    assert describe_presence(presence) == "transition 1 of state Kick"
