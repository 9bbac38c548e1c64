// The search over all pages of the site.
const MAX_RESULTS = 30;

const box = document.querySelector(".search");
const field = document.getElementById("search");
const list = document.getElementById("search-results");
let selectedIndex = 0;
let indexPromise = null;

function loadIndex() {
  indexPromise ??= new Promise((resolve) => {
    const script = document.createElement("script");
    script.src = "search.js";
    script.onload = () => resolve(unpackIndex(window.vicodeSearchIndex));
    document.head.append(script);
  });
  return indexPromise;
}

// Returns entries as [name, kind, parent, URL, doc, code snippets]; the packed index stores shared strings once.
function unpackIndex({ kinds, places, pages, pieces, entries }) {
  return entries.map(([name, kind, where, page, anchor = 0, doc = "", words = []]) => {
    const place = anchor === 0 ? `${kinds[kind]}-${name}` : anchor;
    const code = words.map((number) => pieces[number]);
    return [name, kinds[kind], places[where], pages[page] + (place ? `#${place}` : ""), doc, code];
  });
}

// Lower is better: name, prefix, substring, kind or parent, doc, code; 6 if a word does not match.
function rank(entry, words) {
  let worst = 0;
  const [name, kind, where, , doc, code] = entry.map((text) => text.toString().toLowerCase());
  for (const word of words) {
    let place = 6;
    if (name === word) place = 0;
    else if (name.startsWith(word)) place = 1;
    else if (name.includes(word)) place = 2;
    else if (kind === word || where.includes(word)) place = 3;
    else if (doc.includes(word)) place = 4;
    else if (code.includes(word)) place = 5;
    worst = Math.max(worst, place);
  }
  return worst;
}

function find(entries, text) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return [];
  return entries
    .map((entry, index) => ({ entry, index, rank: rank(entry, words) }))
    .filter((each) => each.rank < 6)
    .sort((a, b) => a.rank - b.rank || a.index - b.index)
    .slice(0, MAX_RESULTS)
    .map((each) => each.entry);
}

// Returns the doc or code snippet that matches most words, cut around the first match, and whether it is code.
function excerpt(entry, text) {
  const [name, kind, where, , doc, code] = entry;
  const words = text.toLowerCase().split(/\s+/).filter((word) => word && !name.toLowerCase().includes(word));
  const said = (body) => words.filter((word) => body.toLowerCase().includes(word));
  const best = [doc, ...code].reduce((one, other) => (said(other).length > said(one).length ? other : one));
  // The line above already names the parent of other kinds.
  if (!said(best).length) return [truncate(doc, 0) || (isTopLevel(kind) ? where : ""), false];
  const at = Math.min(...said(best).map((word) => best.toLowerCase().indexOf(word)));
  const start = at > 60 || best.length > 140 ? Math.max(0, at - 40) : 0;
  return [(start ? "… " : "") + truncate(best, start), best !== doc];
}

const isTopLevel = (kind) => ["component", "interface"].includes(kind);

// Cuts the text after the last word that fits.
function truncate(text, start) {
  const end = start + 140;
  return text.length <= end ? text.slice(start) : `${text.slice(start, end).replace(/\s+\S*$/, "")} …`;
}

// Wraps the search words in <mark> elements.
function highlightMatches(body, text) {
  const words = text.split(/\s+/).filter(Boolean).map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  return body.split(new RegExp(`(${words.join("|")})`, "i")).map((part, at) => {
    if (at % 2 === 0) return part;
    const mark = document.createElement("mark");
    mark.textContent = part;
    return mark;
  });
}

function row(entry, index, text) {
  const item = document.createElement("li");
  item.id = `search-result-${index}`;
  item.role = "option";
  const name = document.createElement("bdi");
  name.append(...highlightMatches(entry[0], text));
  const kind = document.createElement("span");
  kind.className = "kind";
  kind.textContent = isTopLevel(entry[1]) ? entry[1] : `${entry[1]} of ${entry[2]}`;
  const [said, isCode] = excerpt(entry, text);
  const about = document.createElement(isCode ? "code" : "span");
  about.className = "about";
  about.append(...highlightMatches(said, text));
  item.append(kind, name, about);
  item.addEventListener("mousedown", (event) => event.preventDefault());
  item.addEventListener("click", () => go(entry[3]));
  return item;
}

function go(address) {
  close();
  field.blur();
  location.href = address;
}

function close() {
  list.hidden = true;
  field.setAttribute("aria-expanded", "false");
  field.removeAttribute("aria-activedescendant");
}

function selectResult(index) {
  const items = [...list.querySelectorAll("[role=option]")];
  if (!items.length) return;
  selectedIndex = (index + items.length) % items.length;
  items.forEach((item, at) => item.setAttribute("aria-selected", String(at === selectedIndex)));
  items[selectedIndex].scrollIntoView({ block: "nearest" });
  field.setAttribute("aria-activedescendant", items[selectedIndex].id);
}

async function search() {
  const text = field.value;
  const entries = await loadIndex();
  if (text !== field.value) return;
  const found = find(entries, text);
  list.replaceChildren(...found.map((entry, index) => row(entry, index, text)));
  if (text.trim() && !found.length) {
    const item = document.createElement("li");
    item.className = "no-results";
    item.textContent = "No results.";
    list.append(item);
  }
  list.hidden = !text.trim();
  field.setAttribute("aria-expanded", String(!list.hidden));
  selectResult(0);
}

function onSearchKey(event) {
  if (event.key === "ArrowDown") selectResult(selectedIndex + 1);
  else if (event.key === "ArrowUp") selectResult(selectedIndex - 1);
  else if (event.key === "Enter") list.querySelector("[aria-selected=true]")?.click();
  else if (event.key === "Escape") { close(); field.value = ""; field.blur(); }
  else return;
  event.preventDefault();
}

if (box) {
  box.hidden = false;
  // Small screens have no room for the key hint, and usually no keyboard.
  if (matchMedia("(max-width: 800px)").matches) field.placeholder = "Search";
  field.addEventListener("focus", loadIndex);
  field.addEventListener("input", search);
  field.addEventListener("keydown", onSearchKey);
  field.addEventListener("blur", close);
  document.addEventListener("keydown", (event) => {
    const isTyping = event.target.closest?.("input, textarea, select");
    if (isTyping || event.ctrlKey || event.metaKey || event.altKey || event.key !== "/") return;
    event.preventDefault();
    field.focus();
  });
}
