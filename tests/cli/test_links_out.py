"""Links in a folder, which may be from elsewhere, do not make commands write outside of it."""

from pathlib import Path

import pytest

from tests.cli.command_runner import lamps, vicode

__all__ = ["lamps"]


@pytest.mark.parametrize(
    ("link", "arguments"),
    [
        ("lamps/generated/python/lamps/lamp.py", ("gen", "lamps")),
        ("lamps/generated/python", ("gen", "lamps")),
        ("lamps/generated/.vicode", ("gen", "lamps")),
        ("lamps/lamp.svg", ("export", "lamps/lamp.yaml")),
        ("site/component-Lamp.html", ("docs", "lamps", "--out", "site")),
    ],
)
@pytest.mark.parametrize("kind", ["nothing", "a file or folder"])
def test_no_command_writes_through_a_link(
    lamps: Path, tmp_path: Path, link: str, arguments: tuple[str, ...], kind: str
) -> None:
    outside = tmp_path / "outside"
    place = tmp_path / link
    if kind == "a file or folder":
        # Generated, so that only the link is in the way.
        assert vicode(*arguments) == 0
        place.rename(outside)
    place.parent.mkdir(parents=True, exist_ok=True)
    place.symlink_to(outside)
    lamp = lamps / "lamp.yaml"
    lamp.write_text(lamp.read_text().replace("Dark", "Gray"))
    before = contents(outside)
    assert vicode(*arguments) == 2
    assert contents(outside) == before


def contents(place: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in (place, *place.rglob("*")) if path.is_file()}
