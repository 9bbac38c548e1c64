"""Checks the options of `vicode docs` before anything is read: the output folder and the address of the repository."""

from collections.abc import Iterable
from pathlib import Path

_URL_PLACES = ("{path}", "{line}")


def find_output_problem(out: Path, paths: Iterable[Path], *, is_markdown: bool) -> str:
    """Why a site cannot be written to a folder, "" if it can."""
    if out.exists() and not out.is_dir():
        return f"--out {out} is not a folder; choose another --out"
    whole = out.resolve()
    for path in paths:
        inputs = path.resolve() if path.is_dir() else path.resolve().parent
        # Documentation folders of MkDocs and Sphinx may contain the designs.
        if whole == inputs or (not is_markdown and whole in inputs.parents):
            return f"--out {out} contains the designs; choose a folder of its own for the site, such as {out / 'site'}"
    if is_markdown or not out.is_dir() or _is_empty(out) or _is_site(out):
        return ""
    return f"{out} is not empty and was not written by vicode docs; choose another --out or an empty folder"


def find_source_url_problem(source_url: str) -> str:
    """Why an address cannot lead to lines of a repository, "" if it can."""
    if not source_url or (source_url.startswith(("https://", "http://")) and _URL_PLACES[0] in source_url):
        return ""
    return (
        "--source-url must be an http or https address with {path} and {line}, "
        "such as https://github.com/OWNER/REPOSITORY/blob/main/{path}#L{line}"
    )


def _is_empty(out: Path) -> bool:
    return all(each.name.startswith(".") for each in out.iterdir())


def _is_site(out: Path) -> bool:
    # Imported here: a build without changes needs no site writer.
    from vicode.docsite.site_writer import is_generated

    return any(is_generated(each) for each in out.iterdir() if each.is_file())
