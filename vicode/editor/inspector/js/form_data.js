// Reads and completes the nodes of a form, which Python sends as data; see `nodes.py`.

const partsOf = (node) => [node.texts, node.nodes, node.cards].filter(Boolean);

/** The texts of a form by their paths. */
export function textsOf(nodes, texts = new Map()) {
  for (const node of nodes) {
    if (["TextField", "ItemName", "CodeText"].includes(node.is)) texts.set(node.path.join("/"), node.value ?? "");
    for (const part of partsOf(node)) textsOf(part, texts);
  }
  return texts;
}

/** The paths of all cards of a form. */
export function cardsIn(nodes, paths = new Set()) {
  for (const node of nodes) {
    for (const card of node.cards ?? []) paths.add([...node.path, card.id].join("/"));
    for (const part of partsOf(node)) cardsIn(part, paths);
  }
  return paths;
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
