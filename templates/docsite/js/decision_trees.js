// Decision trees: highlights a node and its line of pseudocode together.
const MAX_TREE_HEIGHT = 640;

for (const section of document.querySelectorAll(".state")) {
  const light = (key, on) => {
    for (const node of section.querySelectorAll(".tree [data-key]")) if (node.dataset.key === key) node.classList.toggle("is-highlighted", on);
    document.getElementById(key)?.classList.toggle("is-highlighted", on);
  };
  for (const each of section.querySelectorAll(".tree [data-key], .pseudocode li[id]")) {
    const key = each.dataset.key ?? each.id;
    for (const [event, on] of [["pointerenter", true], ["pointerleave", false], ["focusin", true], ["focusout", false]]) {
      each.addEventListener(event, () => light(key, on));
    }
  }
}

// A slightly too wide tree is scaled down. A wider tree gets the controls of a diagram and is shown at its natural
// size; on touch screens it scrolls with the page.
const hasPointer = matchMedia("(pointer: fine)").matches;
const trees = [...document.querySelectorAll(".tree")].map((tree) => ({ tree, room: tree.clientWidth, width: tree.scrollWidth }));
for (const { tree, room, width } of trees) {
  if (width <= room) continue;
  if (width < room * 1.4 || !hasPointer) tree.classList.toggle("is-fitted", width < room * 1.4);
  else makePannable(tree);
}

function makePannable(tree) {
  const viewport = document.createElement("div");
  viewport.className = "viewport";
  for (const name of ["tabindex", "role", "aria-label"]) {
    viewport.setAttribute(name, tree.getAttribute(name));
    tree.removeAttribute(name);
  }
  viewport.append(...tree.childNodes);
  tree.append(viewport);
  tree.classList.add("diagram");
  new DiagramViewer(tree).showAtNaturalSize(Math.min(MAX_TREE_HEIGHT, Number(viewport.querySelector("svg").getAttribute("height"))));
}

function showTarget() {
  const key = currentAnchor();
  for (const node of document.querySelectorAll(".tree [data-key]")) node.classList.toggle("is-target", node.dataset.key === key);
}
window.addEventListener("hashchange", showTarget);
showTarget();
