// People type into one field, each over a slow connection: a model of the server and of the network, for SyncedText.

const RUNS = 500;
const KINDS = { "whole words only": "checked", "when it is finished": "committed" };
const WORDS = ["the quick brown  fox", "JUMPS OVER  A DOG"];

/** Returns a description of the first fault, or "none". */
export async function findFault(folder, people, stored) {
  const { SyncedText } = await import(`${folder}/synced_text.js`);
  const { mergeTexts } = await import(`${folder}/text_merge.js`);
  for (let seed = 1; seed <= RUNS; seed += 1) {
    const fault = run(seed, people, stored, SyncedText, mergeTexts);
    if (fault) return `seed ${seed}: ${fault}`;
  }
  return "none";
}

function run(seed, people, stored, SyncedText, mergeTexts) {
  const random = randomNumbers(seed);
  const store = (text) => (stored === "without outer spaces" ? text.trim() : text);
  // As a line `name = expression` cannot be read while it is typed.
  const refuses = (text) => stored === "whole words only" && text.endsWith(" ");
  let design = "[]";
  const writers = WORDS.slice(0, people).map((words, number) => ({
    words,
    typed: 0,
    id: 0,
    // One types at the start, the other at the end: their letters must not mix.
    type: (text, letter, count) => (number ? text.slice(0, 1 + count) + letter + text.slice(1 + count) : text + letter),
    field: Object.assign(new SyncedText(design, KINDS[stored]), { hasFocus: true }),
    up: [],
    down: [],
  }));
  const isBusy = ({ words, typed, up, down, field }) => typed < words.length || up.length || down.length || field.isDirty;
  for (let step = 0; writers.some(isBusy); step += 1) {
    if (step > 5000) return "the texts never settle";
    const writer = writers[Math.floor(random() * writers.length)];
    const { field, up, down } = writer;
    const choice = random();
    if (choice < 0.4 && writer.typed < writer.words.length) {
      field.type(writer.type(field.local, writer.words[writer.typed], writer.typed));
      writer.typed += 1;
    } else if (choice < 0.55) {
      // Now and then the user leaves the field or saves.
      const edit = field.takeEdit(writer.id + 1, random() < 0.2);
      if (edit) up.push({ id: (writer.id += 1), ...edit });
    } else if (choice < 0.8 && up.length) {
      const { id, base, text } = up.shift();
      if (refuses(text)) {
        down.push({ id, own: "", error: "refused" });
        continue;
      }
      design = store(refuses(base) || store(base) === design ? text : mergeTexts(base, text, design));
      for (const each of writers) each.down.push({ text: design });
      down.push({ id, own: store(text) });
    } else if (down.length) {
      const before = field.local;
      const { text, id, own, error = "" } = down.shift();
      if (text === undefined) field.acknowledge(id, own, error);
      else field.receive(text);
      if (people === 1 && field.local !== before) return `typed ${before}, shown ${field.local}`;
    }
  }
  // A space typed at the end is lost if the design drops it just when somebody else types.
  const compared = (text) => (people > 1 && stored !== "as typed" ? text.replaceAll(" ", "") : text);
  const expected = store(`[${people > 1 ? WORDS[1] : ""}]${WORDS[0]}`);
  const shown = writers.map(({ field }) => store(field.local));
  if ([design, ...shown].some((text) => compared(text) !== compared(expected))) return `${design}, shown ${shown}, expected ${expected}`;
  return "";
}

function randomNumbers(seed) {
  let state = seed;
  return () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
}
