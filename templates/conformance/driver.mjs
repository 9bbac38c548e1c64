// Runs robots on inputs from files; `vicode conform` passes a file that lists the runs.
import { readFileSync, writeFileSync } from "node:fs";

const SPECIAL = { nan: NaN, inf: Infinity, "-inf": -Infinity };
const toNumber = (text) => SPECIAL[text] ?? Number(text);

function write(value) {
  if (typeof value === "number") {
    return Object.is(value, -0) ? "-0.0" : String(value);
  }
  if (Array.isArray(value)) {
    return `[${value.map(write).join(",")}]`;
  }
  if (value !== null && typeof value === "object") {
    return `{${Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}:${write(each)}`).join(",")}}`;
  }
  return JSON.stringify(value);
}

function element(elements, index) {
  return elements[index % elements.length];
}

/** An output with arguments: its base value, and the weighted sum of its arguments. */
function derive(bica, input, base, given) {
  const groups = [[], [], []];
  for (const argument of input.arguments) {
    const value = given[argument.name];
    const group = argument.elements.length ? 2 : argument.type === "bool" ? 1 : 0;
    groups[group].push(group === 2 ? argument.elements.indexOf(value) : Number(value));
  }
  let total = 0;
  groups.forEach((group, kind) => {
    group.forEach((value, index) => {
      total += [1, 0.5, 0.25][kind] * (index + 1) * value;
    });
  });
  if (input.type === "float" || input.type === "int") {
    return input.type === "int" ? bica.toInt(base + total) : base + total;
  }
  const steps = Math.abs(total) < 2 ** 53 ? Math.floor(Math.abs(total)) : 0;
  return input.type === "bool" ? (base !== 0) !== (steps % 2 === 1) : element(input.elements, base + steps);
}

function convert(bica, input, value) {
  if (input.elements.length) {
    return input.elements[value];
  }
  return input.type === "bool" ? value !== 0 : input.type === "int" ? bica.limit(value) + 0 : value;
}

async function run(each) {
  const bica = await import(`${each.folder}/bica.mjs`);
  const modules = new Map();
  for (const [component, [file, name]] of Object.entries(each.classes)) {
    modules.set(component, (await import(`${each.folder}/${file}`))[name]);
  }
  const root = new bica.Root();
  const main = root.component(modules.get(each.root));
  const shared = each.shared.map((component) => [component, root.component(modules.get(component))]);
  const bases = each.inputs.map(() => 0);
  each.inputs.forEach((input, number) => {
    if (input.arguments !== null) {
      root.component(modules.get(input.component))[input.property] = (given) => derive(bica, input, bases[number], given);
    }
  });
  const lines = [];
  for (const line of readFileSync(each.steps, "ascii").split("\n")) {
    const [command, ...words] = line.split(" ");
    if (command === "s") {
      const [number, value] = [Number(words[1]), toNumber(words[2])];
      const input = each.inputs[number];
      bases[number] = value;
      if (input.arguments === null) {
        const owner = input.component === "" ? main : root.component(modules.get(input.component));
        owner[input.property] = convert(bica, input, value);
      }
    } else if (command === "t") {
      const inputs = Object.fromEntries(shared.map(([name, component]) => [name, component.$values()]));
      root.trace = [];
      root.step(main, Number(words[0]));
      lines.push(write({ iteration: root.iteration, time_ns: root.nowNs, tree: root.trace, errors: [], inputs }));
    }
  }
  writeFileSync(each.trace, lines.join("\n"));
}

for (const each of JSON.parse(readFileSync(process.argv[2], "utf8"))) {
  await run(each);
}
