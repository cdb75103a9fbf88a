// Collects the licences of every package whose code or fonts are in the bundle into one file beside it.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

const fonts = ['@fontsource-variable/inter', '@fontsource-variable/jetbrains-mono'];
const root = new URL('../node_modules/', import.meta.url).pathname;

export function licences() {
  return {
    name: 'licences',
    apply: 'build',
    generateBundle() {
      const names = new Set(fonts);
      for (const id of this.getModuleIds()) {
        const name = /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(id)?.[1];
        if (name) names.add(name);
      }
      const parts = [...names].sort().map(licenceOf).filter(Boolean);
      this.emitFile({ type: 'asset', fileName: 'licences.txt', source: parts.join('\n\n') });
    },
  };
}

function licenceOf(name) {
  const folder = join(root, name);
  if (!existsSync(join(folder, 'package.json'))) return '';
  const about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  const text = file ? readFileSync(join(folder, file), 'utf8').trim() : `Licence: ${about.license}`;
  return `${'='.repeat(80)}\n${name} ${about.version} (${about.license})\n${'='.repeat(80)}\n${text}`;
}
