"""The difference of two scenes."""

from typing import Any

_LISTS = ("states", "transitions", "components", "links", "frames", "notes")


def diff_scenes(old: dict[str, Any], new: dict[str, Any]) -> dict[str, Any]:
    """The changes from one scene to the next: {"rev", "upsert": {list: […]}, "remove": {list: [ids]}, "common"?}."""
    changes: dict[str, Any] = {"rev": new["rev"], "upsert": {}, "remove": {}}
    for name in _LISTS:
        before = {item["id"]: item for item in old[name]}
        after = {item["id"]: item for item in new[name]}
        changes["upsert"][name] = [item for key, item in after.items() if before.get(key) != item]
        changes["remove"][name] = [key for key in before if key not in after]
    if old["common"] != new["common"]:
        changes["common"] = new["common"]
    return changes
