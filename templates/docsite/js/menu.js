// The page menu: adds the state machines by folder and scrolls to the current page.
const MAX_UNFILTERED = 12;
const MAX_OPEN_GROUPS = 40;

const menu = document.querySelector(".menu");

// Allows a line break after an underscore or a slash.
function breakable(name) {
  const node = document.createElement("bdi");
  name.split(/(?<=[_/])/).forEach((part, index) => node.append(...(index ? [document.createElement("wbr"), part] : [part])));
  return node;
}

function menuEntry([name, href, about]) {
  const link = makeElement("a", { href, title: about }, breakable(name));
  if (href === menu.dataset.here) link.setAttribute("aria-current", "page");
  return makeElement("li", {}, link);
}

function menuGroup([folder, machines], isOpen) {
  const list = makeElement("ul", {}, ...machines.map(menuEntry));
  if (!folder) return list;
  const count = makeElement("span", { className: "group-count" }, String(machines.length));
  const group = makeElement("details", { className: "menu-group" }, makeElement("summary", {}, breakable(folder), " ", count), list);
  group.open = isOpen || list.querySelector("[aria-current]") !== null;
  return group;
}

// A field that hides the entries whose text does not contain all words, and the groups without entries.
function makeFilter(label, area, entrySelector, groupSelector) {
  const field = makeElement("input", { type: "search", placeholder: label, autocomplete: "off", spellcheck: false, className: "filter" });
  field.setAttribute("aria-label", label);
  const status = makeElement("p", { className: "filter-status" });
  status.setAttribute("role", "status");
  const entries = [...area.querySelectorAll(entrySelector)].map((node) => ({ node, text: foldText(node.textContent) }));
  const groups = [...area.querySelectorAll(groupSelector)].map((node) => ({ node, wasOpen: node.open }));
  field.addEventListener("input", () => {
    const words = foldText(field.value).split(/\s+/).filter(Boolean);
    let count = 0;
    for (const { node, text } of entries) {
      node.hidden = !words.every((word) => text.includes(word));
      count += !node.hidden;
    }
    for (const { node, wasOpen } of groups) {
      node.hidden = !node.querySelector(`:is(${entrySelector}):not([hidden])`);
      if ("open" in node) node.open = words.length ? true : wasOpen;
    }
    status.textContent = words.length ? `${count} of ${entries.length}` : "";
  });
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    field.value = "";
    field.dispatchEvent(new Event("input"));
  });
  return [field, status];
}

function addStateMachines(groups) {
  const total = groups.reduce((sum, [, machines]) => sum + machines.length, 0);
  if (!total) return;
  const { title } = menu.dataset;
  const box = makeElement("div", { className: "menu-machines" }, ...groups.map((group) => menuGroup(group, total <= MAX_OPEN_GROUPS)));
  const tools = total > MAX_UNFILTERED ? makeFilter(`Filter ${title.toLowerCase()}`, box, "li", ".menu-group") : [];
  menu.querySelector("details").append(makeElement("h2", {}, title), ...tools, box);
}

if (menu && window.vicodeMenu) addStateMachines(window.vicodeMenu);

for (const area of document.querySelectorAll("[data-filter]")) {
  area.prepend(makeElement("div", { className: "content-filter" }, ...makeFilter(area.dataset.filter, area, "tbody tr", ".folder")));
}

// A link to a folder opens it, and a link to a symbol opens its references in the next row.
function openTarget() {
  const target = document.getElementById(currentAnchor());
  const details = target?.matches("tr") ? target.nextElementSibling?.querySelector("details.references") : target;
  if (details?.matches("details")) details.open = true;
}
window.addEventListener("hashchange", openTarget);
openTarget();

// On wide screens the menu is always open. The style sheet does it for browsers without scripts, but accessibility
// tools do not find the links in closed details.
const isWide = matchMedia("(min-width: 801px)");
const updateMenu = () => { if (menu) menu.querySelector("details").open = isWide.matches; };
isWide.addEventListener("change", updateMenu);
updateMenu();

// Scroll a long menu to the current page.
const currentEntry = menu?.querySelector("[aria-current]");
if (currentEntry) {
  const top = currentEntry.getBoundingClientRect().top - menu.getBoundingClientRect().top;
  if (top + currentEntry.offsetHeight > menu.clientHeight) menu.scrollTop = top - menu.clientHeight / 2;
}
