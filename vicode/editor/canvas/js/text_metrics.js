// Measures and truncates texts. Widths are cached by text and font.

export const FONTS = {
  name: '600 14px Roboto, "Segoe UI", system-ui, sans-serif',
  small: '400 11px Roboto, "Segoe UI", system-ui, sans-serif',
  label: '400 12px Roboto, "Segoe UI", system-ui, sans-serif',
};

const FONT_TIMEOUT_MS = 300;

let areLoaded = false;
const loaded = Promise.allSettled(Object.values(FONTS).map((font) => document.fonts.load(font))).then(() => (areLoaded = true));

/** Waits a moment for the web fonts: the layout shifts if they arrive after the first drawing. */
export const awaitFonts = () => Promise.race([loaded, new Promise((done) => setTimeout(done, FONT_TIMEOUT_MS))]);

/** Runs a job when the fonts arrive later; widths measured before may be wrong. */
export function onFontsLoaded(job) {
  if (areLoaded) return;
  loaded.then(() => {
    rulers.clear();
    job();
  });
}

const rulers = new Map();

export const textWidth = (text, font) => rulerOf(font).measure(text);

// One drawing context per font: changing the font takes longer than measuring.
function rulerOf(font) {
  if (!rulers.has(font)) rulers.set(font, new Ruler(FONTS[font]));
  return rulers.get(font);
}

class Ruler {
  constructor(font) {
    this.widths = new Map();
    this.pen = document.createElement("canvas").getContext("2d");
    this.pen.font = font;
  }

  measure(text) {
    let width = this.widths.get(text);
    if (width === undefined) {
      width = this.pen.measureText(text).width;
      this.widths.set(text, width);
    }
    return width;
  }
}

const NAME_SIZE = 14;
const LARGEST_NAME = 28;

/** Returns a name in one line or two, whichever can be larger in a box, and the size of its letters. */
export function largestLines(name, w, h) {
  const sizeOf = (lines) => Math.min(LARGEST_NAME, h / lines.length / 1.1, (NAME_SIZE * w) / Math.max(...lines.map((line) => textWidth(line, "name"))));
  const words = [...name.matchAll(/[\p{Lu}\p{N}]*[^\p{Lu}_\s]*[_\s]?/gu)].map(([word]) => word).filter(Boolean);
  const splits = words.slice(1).map((_, index) => [words.slice(0, index + 1).join(""), words.slice(index + 1).join("")]);
  const lines = [[name], ...splits].reduce((best, each) => (sizeOf(each) > sizeOf(best) ? each : best));
  return { lines, size: Math.floor(sizeOf(lines) * 10) / 10 };
}

// No available width fits more characters; this avoids measuring very long texts.
const MOST_CHARACTERS = 120;

/** Returns the text if it fits, else its beginning and an ellipsis. */
export const truncate = (text, font, room) => shorten(text, font, room, (line, kept) => `${line.slice(0, kept).trimEnd()}…`);

/** Returns a name if it fits, else its beginning and its end: long names often differ in the last word. */
export const truncateMiddle = (name, font, room) =>
  shorten(name, font, room, (line, kept) => {
    const tail = Math.floor(kept / 2);
    return `${line.slice(0, kept - tail).trimEnd()}…${tail ? line.slice(-tail).trimStart() : ""}`;
  });

/** Returns the text if it fits, else what `cut` makes of it with as many characters as fit. */
function shorten(text, font, room, cut) {
  const line = text.replace(/\s+/g, " ").trim();
  let high = Math.min(line.length, MOST_CHARACTERS);
  if (high === line.length && textWidth(line, font) <= room) return line;
  let low = 0;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (textWidth(cut(line, middle), font) <= room) low = middle;
    else high = middle - 1;
  }
  return cut(line, low);
}
