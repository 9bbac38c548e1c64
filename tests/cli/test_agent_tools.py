"""The tools of `vicode mcp` without a server: edits of agents that are unusual or want too much."""

from pathlib import Path

import pytest

from vicode.cli.agent_tools import AgentToolError, AgentTools

LAMP = "vicode: 1\ncomponent: Lamp\ninitial: Off\nstates:\n  Off: {transitions: [{to: Off, after: 1}]}\n"
PROJECT = "vicode: 1\nproject: Lamps\n"


@pytest.fixture
def tools(tmp_path: Path) -> AgentTools:
    folder = tmp_path / "designs"
    folder.mkdir()
    (folder / "project.yaml").write_text(PROJECT)
    (folder / "lamp.yaml").write_text(LAMP)
    return AgentTools(folder, may_edit=True)


def edit(tools: AgentTools, path: str, text: str) -> str:
    return tools.apply_edit(tools.propose_edit(path, text)["id"])


def test_a_new_design_may_have_a_new_folder(tools: AgentTools) -> None:
    assert edit(tools, "lamps/green.yaml", LAMP.replace("Lamp", "Green")) == "wrote lamps/green.yaml"
    assert [each["path"] for each in tools.list_designs()] == ["lamp.yaml", "lamps/green.yaml"]


def test_an_agent_cannot_choose_another_folder_for_generated_files(tools: AgentTools) -> None:
    edit(tools, "project.yaml", f"{PROJECT}generated: ../stolen\n")
    with pytest.raises(AgentToolError, match="only the user"):
        tools.generate()
    assert not (tools.folder.parent / "stolen").exists()
    edit(tools, "project.yaml", f"{PROJECT}generated: code\n")
    assert "code/python/lamps/lamp.py" in tools.generate()


def test_a_folder_that_the_user_chose_outside_is_written(tools: AgentTools) -> None:
    (tools.folder / "project.yaml").write_text(f"{PROJECT}generated: ../code\n")
    edit(tools, "lamp.yaml", f"{LAMP}  On: {{transitions: [{{to: Off, after: 1}}]}}\n")
    assert "code/python/lamps/lamp.py" in tools.generate()


def test_the_same_error_at_a_second_place_is_new(tools: AgentTools) -> None:
    file = tools.folder / "lamp.yaml"
    wrong = LAMP.replace("{to: Off, after: 1}", "{to: On, after: 1}")
    file.write_text(wrong)
    proposed = tools.propose_edit(
        "lamp.yaml", wrong.replace("{to: On, after: 1}", "{to: On, after: 1}, {to: On, after: 2}")
    )
    assert [each["code"] for each in proposed["new_findings"] if each["severity"] == "error"] == ["D402"]
    with pytest.raises(AgentToolError, match="new errors"):
        tools.apply_edit(proposed["id"])


def test_many_findings_are_listed(tools: AgentTools) -> None:
    wrong = ", ".join(f"{{to: Nowhere{number:0100}, after: 1}}" for number in range(400))
    (tools.folder / "lamp.yaml").write_text(LAMP.replace("{to: Off, after: 1}", wrong))
    assert len(tools.check()) >= 400


def test_a_format_that_is_no_picture_or_text_is_refused(tools: AgentTools) -> None:
    with pytest.raises(AgentToolError, match="mermaid, plantuml, dot, svg, png"):
        tools.render("lamp.yaml", "pdf")
