// Comparison of texts as people type them: without accents and case, by the parts of names, and with typing errors.
const LETTERS = { ß: "ss", æ: "ae", œ: "oe", ø: "o", ł: "l", đ: "d", ı: "i", ς: "σ" };
const INITIALS_LENGTH = 2;

// Lower case without accents.
function foldText(text) {
  return text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase().replace(/[ßæœøłđıς]/g, (letter) => LETTERS[letter]);
}

// The parts of a name in camelCase or snake_case, folded.
function nameParts(name) {
  const spaced = name.replace(/(\p{Ll}|\d)(\p{Lu})/gu, "$1 $2").replace(/(\p{Lu})(\p{Lu}\p{Ll})/gu, "$1 $2");
  return foldText(spaced).split(/[^\p{L}\p{N}]+/u).filter(Boolean);
}

// Whether a folded word begins parts of a name, one after the other: "lookball", "lfb" and "ball" are in LookForBall.
function matchesParts(word, parts) {
  if (parts.some((part) => part.startsWith(word))) return true;
  if (word.length >= INITIALS_LENGTH && parts.map((part) => part[0]).join("").startsWith(word)) return true;
  // Suffixes of the word that do not match from a part on: a name such as a_a_a_a has many ways to fail.
  const failed = new Set();
  const matchesFrom = (rest, at) => {
    if (!rest) return true;
    const key = `${rest.length} ${at}`;
    if (failed.has(key)) return false;
    const matches = parts.slice(at).some((part, skipped) => {
      const isWhole = rest.startsWith(part);
      return (isWhole && matchesFrom(rest.slice(part.length), at + skipped + 1)) || (rest !== word && part.startsWith(rest));
    });
    if (!matches) failed.add(key);
    return matches;
  };
  return matchesFrom(word, 0);
}

// The number of typing errors that are forgiven in a word.
const allowedErrors = (word) => (word.length < 4 ? 0 : word.length < 8 ? 1 : 2);

// Whether two words differ by at most `limit` inserted, missing, wrong or swapped letters.
function isSimilar(one, other, limit) {
  if (Math.abs(one.length - other.length) > limit) return false;
  let before = [];
  let last = Array.from({ length: other.length + 1 }, (_, index) => index);
  for (let row = 1; row <= one.length; row += 1) {
    const next = [row];
    for (let column = 1; column <= other.length; column += 1) {
      const isSame = one[row - 1] === other[column - 1];
      next[column] = Math.min(last[column] + 1, next[column - 1] + 1, last[column - 1] + (isSame ? 0 : 1));
      const isSwapped = row > 1 && column > 1 && one[row - 1] === other[column - 2] && one[row - 2] === other[column - 1];
      if (isSwapped) next[column] = Math.min(next[column], before[column - 2] + 1);
    }
    if (Math.min(...next) > limit) return false;
    [before, last] = [last, next];
  }
  return last[other.length] <= limit;
}

// Ranges [start, end) of a text that equal one of the folded words, in order and without overlaps.
function findRanges(text, words) {
  let folded = "";
  const origins = [];
  let at = 0;
  for (const letter of text) {
    const plain = foldText(letter);
    folded += plain;
    for (let count = 0; count < plain.length; count += 1) origins.push([at, at + letter.length]);
    at += letter.length;
  }
  const ranges = [];
  for (const word of words) {
    for (let index = folded.indexOf(word); word && index >= 0; index = folded.indexOf(word, index + word.length)) {
      ranges.push([origins[index][0], origins[index + word.length - 1][1]]);
    }
  }
  ranges.sort(([a, b], [c, d]) => a - c || d - b);
  return ranges.filter(([start], index) => ranges.slice(0, index).every(([, end]) => end <= start));
}
