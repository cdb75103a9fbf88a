// Styles come with the part of the page that needs them: what a component has as its class is styled in a
// sheet that is loaded with it. One that comes with another part only is missing until that is opened.
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const kEntry = join(root, 'app/main.tsx');

const all = readdirSync(join(root, 'app'), { recursive: true, encoding: 'utf8' })
  .concat(
    readdirSync(join(root, 'core'), { recursive: true, encoding: 'utf8' }).map(
      (one) => `../core/${one}`,
    ),
  )
  .map((one) => join(root, 'app', one));
const sources = all.filter((one) => /\.tsx?$/.test(one) && !/\.test\.tsx?$/.test(one));
const texts = new Map(sources.map((file) => [file, readFileSync(file, 'utf8')]));
const sheets = new Map(
  all
    .filter((one) => one.endsWith('.css'))
    .map((file) => {
      const rules = readFileSync(file, 'utf8').replaceAll(/\/\*.*?\*\//gs, '');
      return [file, new Set([...rules.matchAll(/\.([a-z][\w-]*)/g)].map(([, name]) => name))];
    }),
);

function fileOf(from, path) {
  if (!path.startsWith('.')) return null;
  const file = join(dirname(from), path);
  return (
    [file, `${file}.ts`, `${file}.tsx`].find((one) => texts.has(one) || sheets.has(one)) ?? null
  );
}

/** What a file brings along at once, and what later. */
function importsOf(file) {
  const text = texts.get(file) ?? '';
  const found = (pattern) =>
    [...text.matchAll(pattern)].flatMap(([, path]) => fileOf(file, path) ?? []);
  return {
    now: found(/^(?:import|export)\s(?!type)[^;]*?'([^']+)';/gm),
    later: found(/import\(\s*'([^']+)'\s*\)/g),
  };
}
const imports = new Map(sources.map((file) => [file, importsOf(file)]));

/** All that is there once the file is. */
function partOf(file, part = new Set()) {
  if (part.has(file)) return part;
  part.add(file);
  for (const next of imports.get(file)?.now ?? []) partOf(next, part);
  return part;
}
const starts = new Set([kEntry, ...sources.flatMap((file) => imports.get(file).later)]);
const parts = new Map([...starts].map((file) => [file, partOf(file)]));

// A part that is loaded by others finds what each of them has; the entry has nothing before it.
const there = new Map([...starts].map((one) => [one, new Set(sheets.keys())]));
for (let changed = true; changed;) {
  changed = false;
  for (const [start, part] of parts) {
    const own = [...part].filter((one) => sheets.has(one));
    const callers = [...parts].filter(([, other]) =>
      [...other].some((file) => imports.get(file)?.later.includes(start)),
    );
    const given = [...sheets.keys()].filter(
      (sheet) => start !== kEntry && callers.every(([caller]) => there.get(caller).has(sheet)),
    );
    const now = new Set([...own, ...given]);
    if (now.size !== there.get(start).size) changed = true;
    there.set(start, now);
  }
}

function classesIn(text) {
  const attributes = [...text.matchAll(/className=(?:"([^"]*)"|\{((?:[^{}]|\{[^{}]*\})*)\})/g)];
  return new Set(
    attributes.flatMap(([, plain, code]) =>
      plain === undefined
        ? [...code.matchAll(/['`"]([^'`"]*)['`"]/g)].flatMap(([, words]) => words.split(/\s+/))
        : plain.split(/\s+/),
    ),
  );
}

// What phones change in parts of the window comes with the page for phones, and is for it alone.
sheets.delete(join(root, 'app/look/phone.css'));

const complaints = new Set();
for (const [start, part] of parts)
  for (const file of part)
    for (const name of classesIn(texts.get(file) ?? '')) {
      const styled = [...sheets].filter(([, names]) => names.has(name)).map(([sheet]) => sheet);
      if (styled.length === 0 || styled.some((sheet) => there.get(start).has(sheet))) continue;
      complaints.add(
        `${relative(root, file)}: the class ${name} is styled in ${relative(root, styled[0])}, which does not come with ${relative(root, start)}; import it`,
      );
    }
for (const one of [...complaints].sort()) console.error(one);
if (complaints.size > 0) process.exit(1);
