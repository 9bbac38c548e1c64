// Reads and completes the nodes of a form, which Python sends as data; see `nodes.py`.

import { SyncedText } from "./synced_text.js";

const partsOf = (node) => [node.texts, node.nodes, node.cards].filter(Boolean);

/** The nodes of a form that have texts, by their paths. */
export function textNodes(nodes, found = new Map()) {
  for (const node of nodes) {
    if (["TextField", "ItemName", "CodeText"].includes(node.is)) found.set(node.path.join("/"), node);
    for (const part of partsOf(node)) textNodes(part, found);
  }
  return found;
}

/** The `SyncedText` of a node. */
export function syncedText(node) {
  const kinds = { name: node.is === "ItemName", committed: node.is_committed, checked: node.is_checked };
  return new SyncedText(node.value ?? "", Object.keys(kinds).find((kind) => kinds[kind]));
}

/** The paths of all cards of a form. */
export function cardsIn(nodes, paths = new Set()) {
  for (const node of nodes) {
    for (const card of node.cards ?? []) paths.add([...node.path, card.id].join("/"));
    for (const part of partsOf(node)) cardsIn(part, paths);
  }
  return paths;
}

/** A path in which the ids of cards, which are those of one run of the server, are replaced by their indices. */
export function placeOf(nodes, path) {
  for (const node of nodes) {
    const index = (node.cards ?? []).findIndex(({ id }) => path.startsWith([...node.path, id, ""].join("/")));
    if (index >= 0) {
      const { id, nodes: inner = [] } = node.cards[index];
      return placeOf(inner, path).replace([...node.path, id].join("/"), () => [...node.path, `#${index}`].join("/"));
    }
    path = placeOf(node.nodes ?? [], path);
  }
  return path;
}

/** The nodes with the cards that the design does not have yet, at the ends of their lists. */
export function withPending(nodes, pending) {
  for (const node of nodes) {
    if (node.is === "Cards") {
      const added = pending.filter(({ list }) => list === node.path.join("/")).map(({ card }) => card);
      node.cards = [...(node.cards ?? []), ...added];
    }
    for (const part of partsOf(node)) withPending(part, pending);
  }
  return nodes;
}

/** The nodes of a new card: their paths follow that of the card. */
export function placed(nodes, path, alias) {
  return nodes.map((node) => ({
    ...node,
    ...(node.path || node.is === "Group" ? { path: [...path, ...(node.path ?? [])] } : {}),
    ...(node.look && node.is === "Section" ? { key: (node.key ?? "") + path.join("/") } : {}),
    ...(alias && node.language === "pairs" ? { alias } : {}),
    ...(node.texts ? { texts: placed(node.texts, path, alias) } : {}),
    ...(node.nodes ? { nodes: placed(node.nodes, path, alias) } : {}),
  }));
}

/** The nodes with the parts that several forms show; `forms` has their texts by their keys. */
export function expanded(nodes, forms) {
  return nodes.flatMap((node) => {
    if (node.is === "FormPart") return expanded(JSON.parse(forms.get(node.form) ?? "[]"), forms);
    for (const name of ["nodes", "cards"]) if (node[name]) node[name] = expanded(node[name], forms);
    return [node];
  });
}

/** Gives the nodes of a new card its name. */
export function named(nodes, name) {
  const [first] = nodes;
  if ("title" in first || first.is === "Group") first.title = name;
  if (first.nodes) named(first.nodes, name);
  else first.value = name;
}
