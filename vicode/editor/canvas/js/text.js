// How wide a text is, and how it is shortened. Measured once per text and font.

export const FONTS = {
  name: '600 14px Roboto, "Segoe UI", system-ui, sans-serif',
  small: '400 11px Roboto, "Segoe UI", system-ui, sans-serif',
  label: '400 12px Roboto, "Segoe UI", system-ui, sans-serif',
};

const widths = new Map();
const pen = document.createElement("canvas").getContext("2d");

export function textWidth(text, font) {
  const key = `${font}|${text}`;
  let width = widths.get(key);
  if (width === undefined) {
    pen.font = FONTS[font];
    width = pen.measureText(text).width;
    widths.set(key, width);
  }
  return width;
}

/** The text itself when it fits, else its beginning and an ellipsis. */
export function shorten(text, font, room) {
  const line = text.replace(/\s+/g, " ").trim();
  // Nothing longer than this can fit in any room we have; it spares measuring a novel.
  const start = line.length > 120 ? line.slice(0, 120) : line;
  if (start === line && textWidth(line, font) <= room) return line;
  let low = 0;
  let high = start.length;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (textWidth(`${start.slice(0, middle)}…`, font) <= room) low = middle;
    else high = middle - 1;
  }
  return `${start.slice(0, low).trimEnd()}…`;
}

/** A web font arrived: what was measured before it may be wrong. */
export const forgetWidths = () => widths.clear();
