// Merges two concurrent changes of a text, as the server does in `text_merge.py`.

/** The smallest region of `old` whose replacement gives `now`. */
export function findChange(old, now) {
  const limit = Math.min(old.length, now.length);
  let start = 0;
  while (start < limit && old[start] === now[start]) start += 1;
  let kept = 0;
  while (kept < limit - start && old[old.length - 1 - kept] === now[now.length - 1 - kept]) kept += 1;
  return { start, end: old.length - kept, text: now.slice(start, now.length - kept) };
}

/** The text with both changes of `base`; at the same place, the text of `ours` comes first. */
export function mergeTexts(base, ours, theirs) {
  if (ours === base || ours === theirs) return theirs;
  if (theirs === base) return ours;
  const changes = [findChange(base, ours), findChange(base, theirs)].sort((a, b) => a.start - b.start);
  let merged = "";
  let at = 0;
  for (const change of changes) {
    merged += keptText(base, at, change.start, changes) + change.text;
    at = change.start;
  }
  return merged + keptText(base, at, base.length, changes);
}

function keptText(base, from, end, changes) {
  let start = from;
  let kept = "";
  for (const change of changes) {
    kept += base.slice(start, Math.min(change.start, end));
    start = Math.max(start, Math.min(change.end, end));
  }
  return kept + base.slice(start, end);
}
