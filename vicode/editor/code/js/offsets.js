// Python counts characters, JavaScript counts halves of those beyond the first 65536.

// From a character of a text, as Python counts, to a place in the string.
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

// From a place in the string to a character as Python counts.
export function toCharacters(text, unit) {
  return [...text.slice(0, unit)].length;
}
