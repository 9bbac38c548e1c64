"""The difference of two scenes."""

from vicode.editor.view.scene_types import SCENE_LISTS, Scene, SceneChanges


def diff_scenes(old: Scene, new: Scene) -> SceneChanges:
    """The changes from one scene to the next."""
    changes: SceneChanges = {"rev": new["rev"], "upsert": {}, "remove": {}}
    for name in SCENE_LISTS:
        before = {item["id"]: item for item in old[name]}
        after = {item["id"]: item for item in new[name]}
        changes["upsert"][name] = [item for key, item in after.items() if before.get(key) != item]
        changes["remove"][name] = [key for key in before if key not in after]
    if old["common"] != new["common"]:
        changes["common"] = new["common"]
    return changes
