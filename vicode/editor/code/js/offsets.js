// Converts between offsets in characters (Python) and in UTF-16 code units (JavaScript).

// Returns a function from character offsets to code unit offsets.
export function toUnits(text) {
  if (!/[\uD800-\uDBFF]/.test(text)) return (index) => index;
  const units = [];
  let unit = 0;
  for (const character of text) {
    units.push(unit);
    unit += character.length;
  }
  units.push(unit);
  return (index) => units[Math.max(0, Math.min(index, units.length - 1))];
}

// Converts an offset in code units to an offset in characters.
export function toCharacters(text, unit) {
  return [...text.slice(0, unit)].length;
}
