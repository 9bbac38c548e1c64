// The search over all pages of the site.
const RESULTS_PER_STEP = 30;

const field = makeElement("input", { id: "search", type: "search", placeholder: "Search  (press /)", autocomplete: "off", spellcheck: false, maxLength: 200, role: "combobox" });
const list = makeElement("ul", { id: "search-results", role: "listbox", hidden: true });
const searchStatus = makeElement("span", { className: "visually-hidden", role: "status" });
for (const [name, value] of Object.entries({ "aria-label": "Search names, docs and code", "aria-expanded": "false", "aria-controls": list.id, "aria-autocomplete": "list" })) {
  field.setAttribute(name, value);
}
list.setAttribute("aria-label", "Search results");
let selectedIndex = 0;
let resultLimit = RESULTS_PER_STEP;
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

// The folded texts of an entry, made when it is first searched.
const foldedTexts = new WeakMap();

function foldEntry(entry) {
  if (!foldedTexts.has(entry)) {
    const [name, kind, where, , doc, code] = entry;
    const parts = nameParts(name);
    const texts = { name: foldText(name), parts, joined: parts.join(""), kind, where: foldText(where), doc: foldText(doc), code: foldText(code.join("\n")) };
    foldedTexts.set(entry, texts);
  }
  return foldedTexts.get(entry);
}

// Lower is better: name, prefix, parts of the name, substring, kind or parent, doc, code, similar name; NO_MATCH if none.
const NO_MATCH = 8;

function rankWord(texts, word, isLenient) {
  if (texts.name === word || texts.joined === word) return 0;
  if (texts.name.startsWith(word) || texts.joined.startsWith(word)) return 1;
  if (matchesParts(word, texts.parts)) return 2;
  if (texts.name.includes(word) || texts.joined.includes(word)) return 3;
  if (texts.kind === word || texts.where.includes(word)) return 4;
  if (texts.doc.includes(word)) return 5;
  if (texts.code.includes(word)) return 6;
  const limit = isLenient ? allowedErrors(word) : 0;
  return limit && [texts.joined, ...texts.parts].some((part) => isSimilar(word, part, limit)) ? 7 : NO_MATCH;
}

function rankEntries(entries, words, isLenient) {
  const ranked = entries.map((entry, index) => {
    const ranks = words.map((word) => rankWord(foldEntry(entry), word, isLenient));
    const isPhrase = words.length > 1 && foldEntry(entry).code.includes(words.join(" "));
    return { entry, index, isPhrase, worst: Math.max(...ranks), sum: ranks.reduce((sum, rank) => sum + rank, 0) };
  });
  return ranked
    .filter((each) => each.worst < NO_MATCH)
    .sort((a, b) => a.worst - b.worst || b.isPhrase - a.isPhrase || a.sum - b.sum || a.index - b.index)
    .map((each) => each.entry);
}

const searchWords = (text) => foldText(text).split(/\s+/).filter(Boolean);

// All results, best first. Typing errors are forgiven if nothing is found otherwise.
function find(entries, text) {
  // Underscores in a search separate parts of names, as in names.
  const words = searchWords(text).map((word) => word.replace(/(?<=.)_(?=.)/g, ""));
  if (!words.length) return { found: [], isLenient: false };
  const exact = rankEntries(entries, searchWords(text), false);
  return exact.length ? { found: exact, isLenient: false } : { found: rankEntries(entries, words, true), isLenient: true };
}

// Returns the doc or code snippet that matches most words, cut around the first match, and whether it is code.
function excerpt(entry, text) {
  const [name, kind, where, , doc, code] = entry;
  const words = searchWords(text).filter((word) => !foldText(name).includes(word));
  const said = (body) => words.filter((word) => foldText(body).includes(word));
  const best = [doc, ...code].reduce((one, other) => (said(other).length > said(one).length ? other : one));
  // The line above already names the parent of other kinds.
  if (!said(best).length) return [truncate(doc, 0) || (isTopLevel(kind) ? where : ""), false];
  const at = findRanges(best, said(best))[0][0];
  const start = at > 60 || best.length > 140 ? Math.max(0, at - 40) : 0;
  return [(start ? "… " : "") + truncate(best, start), best !== doc];
}

const isTopLevel = (kind) => ["component", "interface", "option", "basic behavior", "namespace"].includes(kind);

// Cuts the text after the last word that fits.
function truncate(text, start) {
  const end = start + 140;
  return text.length <= end ? text.slice(start) : `${text.slice(start, end).replace(/\s+\S*$/, "")} …`;
}

// Wraps the search words in <mark> elements.
function highlightMatches(body, text) {
  const nodes = [];
  let last = 0;
  for (const [start, end] of findRanges(body, searchWords(text))) {
    nodes.push(body.slice(last, start), makeElement("mark", {}, body.slice(start, end)));
    last = end;
  }
  return [...nodes, body.slice(last)];
}

function row(entry, index, text) {
  const item = makeElement("li", { id: `search-result-${index}`, role: "option" });
  const name = makeElement("bdi", {}, ...highlightMatches(entry[0], text));
  const kind = makeElement("span", { className: "kind" }, isTopLevel(entry[1]) ? entry[1] : `${entry[1]} of ${entry[2]}`);
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
  searchStatus.textContent = "";
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
  resultLimit = RESULTS_PER_STEP;
  showResults(find(entries, text), text);
  selectResult(0);
}

function showResults(results, text) {
  const { found, isLenient } = results;
  const items = found.slice(0, resultLimit).map((entry, index) => row(entry, index, text));
  if (found.length > resultLimit) items.push(moreRow(results, text));
  const count = `${found.length} result${found.length === 1 ? "" : "s"}`;
  const hint = !found.length ? "No results." : isLenient ? "No exact match. Similar names:" : "";
  if (hint && text.trim()) items.unshift(makeElement("li", { className: "no-results", role: "presentation" }, hint));
  list.replaceChildren(...items);
  list.hidden = !text.trim();
  searchStatus.textContent = list.hidden ? "" : `${hint} ${found.length ? count : ""}`.trim();
  field.setAttribute("aria-expanded", String(!list.hidden));
}

// The last row shows further results.
function moreRow(results, text) {
  const label = `${resultLimit} of ${results.found.length} results. Show more`;
  const item = makeElement("li", { id: "search-more", role: "option", className: "more-results" }, label);
  item.addEventListener("mousedown", (event) => event.preventDefault());
  item.addEventListener("click", () => {
    const first = resultLimit;
    resultLimit += RESULTS_PER_STEP;
    showResults(results, text);
    selectResult(first);
  });
  return item;
}

function onSearchKey(event) {
  if (event.key === "ArrowDown") selectResult(selectedIndex + 1);
  else if (event.key === "ArrowUp") selectResult(selectedIndex - 1);
  else if (event.key === "Enter") list.querySelector("[aria-selected=true]")?.click();
  else if (event.key === "Escape") { close(); field.value = ""; field.blur(); }
  else return;
  event.preventDefault();
}

document.querySelector(".top").append(makeElement("div", { className: "search", role: "search" }, field, list, searchStatus));
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
