// Decision trees: a box and the line of pseudo code that says the same are shown together.
const TALLEST = 640;

for (const section of document.querySelectorAll(".state")) {
  const light = (key, on) => {
    for (const node of section.querySelectorAll(".tree [data-key]")) if (node.dataset.key === key) node.classList.toggle("is-lit", on);
    document.getElementById(key)?.classList.toggle("is-lit", on);
  };
  for (const each of section.querySelectorAll(".tree [data-key], .pseudo li[id]")) {
    const key = each.dataset.key ?? each.id;
    for (const [event, on] of [["pointerenter", true], ["pointerleave", false], ["focusin", true], ["focusout", false]]) {
      each.addEventListener(event, () => light(key, on));
    }
  }
}

// One that is little wider than its place is shown a little smaller. A wide one gets the tools of a drawing, and begins
// in its own size; a finger moves it as it moves the page.
const hasPointer = matchMedia("(pointer: fine)").matches;
const trees = [...document.querySelectorAll(".tree")].map((tree) => ({ tree, room: tree.clientWidth, width: tree.scrollWidth }));
for (const { tree, room, width } of trees) {
  if (width <= room) continue;
  if (width < room * 1.4 || !hasPointer) tree.classList.toggle("is-fitted", width < room * 1.4);
  else makeMovable(tree);
}

function makeMovable(tree) {
  const sheet = document.createElement("div");
  sheet.className = "sheet";
  for (const name of ["tabindex", "role", "aria-label"]) {
    sheet.setAttribute(name, tree.getAttribute(name));
    tree.removeAttribute(name);
  }
  sheet.append(...tree.childNodes);
  tree.append(sheet);
  tree.classList.add("drawing");
  new Drawing(tree).begin(Math.min(TALLEST, Number(sheet.querySelector("svg").getAttribute("height"))));
}

function showTarget() {
  const key = decodeURIComponent(location.hash.slice(1));
  for (const node of document.querySelectorAll(".tree [data-key]")) node.classList.toggle("is-target", node.dataset.key === key);
}
window.addEventListener("hashchange", showTarget);
showTarget();
