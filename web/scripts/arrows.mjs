// The layers of the pages: protocol <- core <- app; aesl imports none of them. The help of app shows pages of ../docs as they are.
// An arrow means "may import". Inside app no arrow leads upwards: storeys, below. Packages that draw stay out of core.
// A class is styled in one file of app/look: most of them come with what is first shown, and the last one would win everywhere.
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join, relative, resolve } from 'node:path';

const root = new URL('..', import.meta.url).pathname;
const may = {
  protocol: ['protocol'],
  core: ['protocol', 'core'],
  aesl: ['aesl'],
  app: ['protocol', 'core', 'aesl', 'app', 'docs'],
};
const packages = {
  protocol: /^$/,
  core: /^(zustand\/vanilla|@codemirror\/(collab|commands|merge|state))$/,
  aesl: /^(@lezer\/|@codemirror\/(language|state)$)/,
};

/** Of app, from above to below: a folder may import what follows it; files beside the folders are for all. */
const storeys = [
  'phone',
  'dock',
  'overlay',
  'start',
  'topbar',
  'panels',
  'views',
  'commands',
  'parts',
  'look',
];

const wrong = [];
/** What each file imports of ours, types included. */
const imports = new Map();
for (const layer of Object.keys(may))
  for (const file of filesOf(join(root, layer))) check(layer, file);
checkCircles();
checkClasses();
for (const line of wrong) console.error(line);
process.exit(wrong.length ? 1 : 0);

function check(layer, file) {
  const test = /\.test\.tsx?$/.test(file);
  imports.set(file, []);
  for (const [, target] of readFileSync(file, 'utf8').matchAll(
    /(?:from|import)\s*\(?\s*'([^']+)'/g,
  )) {
    if (target.startsWith('.')) {
      const path = relative(root, resolve(dirname(file), target));
      const other = path.replace(/^\.\.\/(?=docs\/)/, '').split('/')[0];
      if (!may[layer].includes(other) && !(test && other in may))
        wrong.push(`${relative(root, file)}: ${layer} may not import ${other} (${target})`);
      checkStorey(file, target);
      imports.get(file).push(resolve(dirname(file), target));
    } else if (!test && packages[layer] && !packages[layer].test(target))
      wrong.push(`${relative(root, file)}: ${layer} may not import ${target}`);
  }
  const lines = readFileSync(file, 'utf8').split('\n').length;
  if (file.endsWith('.tsx') && lines > 151)
    wrong.push(`${relative(root, file)}: a component of ${lines} lines; at most 150`);
}

function checkStorey(file, target) {
  const storeyOf = (path) => storeys.indexOf(relative(join(root, 'app'), path).split('/')[0]);
  const [from, to] = [storeyOf(file), storeyOf(resolve(dirname(file), target))];
  if (from >= 0 && to >= 0 && to < from)
    wrong.push(
      `${relative(root, file)}: ${storeys[from]} may not import ${storeys[to]} (${target})`,
    );
}

/** Files that need each other are one file in two places: each circle is told once. */
function checkCircles() {
  const done = new Set();
  const visit = (file, way) => {
    const at = way.indexOf(file);
    if (at >= 0) {
      const names = [...way.slice(at), file].map((one) => relative(root, one));
      wrong.push(`${names.join(' -> ')}: a circle; move what both need to a file of its own`);
    } else if (!done.has(file)) {
      for (const path of imports.get(file) ?? [])
        for (const end of ['.ts', '.tsx'])
          if (imports.has(path + end)) visit(path + end, [...way, file]);
      done.add(file);
    }
  };
  for (const file of imports.keys()) visit(file, []);
}

function checkClasses() {
  const homes = new Map();
  const look = join(root, 'app/look');
  for (const name of readdirSync(look).sort())
    for (const one of classesOf(readFileSync(join(look, name), 'utf8'))) {
      const home = homes.get(one) ?? name;
      homes.set(one, home);
      if (home !== name)
        wrong.push(
          `app/look/${name}: .${one} is styled in ${home}, too; give one of them another name`,
        );
    }
}

/** The classes that are a whole selector: `.tool {`, not `.row .tool {`. */
function classesOf(css) {
  const rules = css.replace(/\/\*[^]*?\*\//g, '').matchAll(/(?:^|[{};])\s*([^{};@]+)\{/g);
  return [...rules].flatMap(([, selectors]) =>
    selectors.split(',').flatMap((one) => /^\s*\.([\w-]+)\s*$/.exec(one)?.[1] ?? []),
  );
}

function filesOf(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    if (entry.isDirectory()) return filesOf(join(folder, entry.name));
    return /\.tsx?$/.test(entry.name) ? [join(folder, entry.name)] : [];
  });
}
