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
export const syncedText = (node) => new SyncedText(node.value ?? "", node.is === "ItemName" ? "name" : node.is_checked && "checked");

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
    if (index >= 0) return path.replace([...node.path, node.cards[index].id].join("/"), () => [...node.path, `#${index}`].join("/"));
    for (const part of [node.nodes, node.texts].filter(Boolean)) path = placeOf(part, path);
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
    ...(node.path ? { path: [...path, ...node.path] } : {}),
    ...(alias && node.language === "pairs" ? { alias } : {}),
    ...(node.texts ? { texts: placed(node.texts, path, alias) } : {}),
    ...(node.nodes ? { nodes: placed(node.nodes, path, alias) } : {}),
  }));
}
