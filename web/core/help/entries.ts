// What the help has an entry for: words of the language, and what the nodes of the target told of themselves.

import type { LocalEvent, Native, Variable } from '../../protocol/messages';
import { fuzzy, scoreOf } from '../rank';
import { examplesIn, textOf, type Section } from './page';

export interface HelpEntry {
  kind: 'word' | 'topic' | 'variable' | 'event' | 'native';
  name: string;
  /** What it is in one line. */
  help: string;
  /** How it is written: a call, a size. */
  form: string;
  /** Where the language is explained. */
  section?: Section;
  /** A program that uses it. */
  example?: string;
  /** The node that has it; empty for the language. */
  node: string;
}

/** What a node told of itself. */
export interface NodeWords {
  name: string;
  variables: readonly Variable[];
  events: readonly LocalEvent[];
  natives: readonly Native[];
}

const isTable = (title: string) => title.startsWith('All words');

/** The words of the table of the page, each with the section that explains it; then the sections. */
export function languageEntries(sections: readonly Section[]): HelpEntry[] {
  const taught = sections.filter(({ title }) => !isTable(title));
  const words = sections.filter(({ title }) => isTable(title)).flatMap(({ blocks }) => blocks);
  const entries = new Map<string, HelpEntry>();
  for (const block of words) {
    if (block.is !== 'table') continue;
    for (const [cell = '', help = ''] of block.rows) {
      const row = [...cell.matchAll(/`([^`]+)`/g)].map(([, word]) => word ?? '');
      const first = sectionOf(taught, row[0] ?? '');
      for (const name of row) {
        const section = first && mentions(first, name) ? first : (sectionOf(taught, name) ?? first);
        const entry = { kind: 'word', name, help: plain(help), form: '', node: '' } as const;
        if (!entries.has(name)) entries.set(name, section ? { ...entry, section } : entry);
      }
    }
  }
  const topics = taught.map((section): HelpEntry => {
    const name = plain(section.title);
    return { kind: 'topic', name, help: '', form: '', node: '', section };
  });
  return [...entries.values(), ...topics];
}

function plain(text: string): string {
  return text.replaceAll('`', '');
}

function mentions(section: Section, word: string): boolean {
  return textOf(section).includes(`\`${word}\``) || uses(examplesIn([section]), word) !== undefined;
}

/** Where a word is explained: in its heading, in the text, by an example; the first of the best. */
function sectionOf(sections: readonly Section[], word: string): Section | undefined {
  return (
    sections.find(({ title }) => title.includes(`\`${word}\``)) ??
    sections.find((section) => textOf(section).includes(`\`${word}\``)) ??
    sections.find((section) => uses([textOf(section)], word) !== undefined)
  );
}

/** The first text in which a name stands as a word of its own. */
function uses(texts: readonly string[], name: string): string | undefined {
  const word = name.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');
  const whole = new RegExp(`(?<![\\w.])${word}(?![\\w.])`);
  return texts.find((text) => whole.test(text));
}

/** Variables, events and natives; of several nodes of one name the first counts. */
export function robotEntries(
  nodes: readonly NodeWords[],
  examples: readonly string[],
): HelpEntry[] {
  const known = new Map(nodes.toReversed().map((node) => [node.name, node]));
  return [...known.values()].reverse().flatMap((node) => {
    const entry = (
      kind: HelpEntry['kind'],
      name: string,
      form: string,
      help: string,
      use = name,
    ): HelpEntry => {
      const example = uses(examples, use);
      return { kind, name, form, help, node: node.name, ...(example ? { example } : {}) };
    };
    return [
      ...node.variables
        .filter((one) => one.of === 'node')
        .map((one) => entry('variable', one.name, formOf(one), one.help ?? '')),
      ...node.events.map((one) =>
        entry('event', one.name, `onevent ${one.name}`, one.help, `onevent ${one.name}`),
      ),
      ...node.natives.map((one) =>
        entry('native', one.name, callOf(one), one.help, `call ${one.name}`),
      ),
    ];
  });
}

/** "prox.horizontal[7]", "timer.period[2] = … ms". */
function formOf({ name, size, unit, writable }: Variable): string {
  const array = size > 1 ? `${name}[${size}]` : name;
  return `${array}${writable ? ' = …' : ''}${unit ? ` ${unit}` : ''}`;
}

function callOf({ name, parameters }: Native): string {
  const parts = parameters.map((one) => (one.size > 1 ? `${one.name}[${one.size}]` : one.name));
  return `call ${name}(${parts.join(', ')})`;
}

/** A word in the explanation counts less than any letters of the name. */
const kInText = 10_000;

/** Found by letters of the name in their order, else by words of the explanation; best first. */
export function findHelp(entries: readonly HelpEntry[], query: string): HelpEntry[] {
  const wanted = query.trim();
  if (wanted === '') return [...entries];
  const scored = entries.flatMap((entry) => {
    const score = scoreFor(entry, wanted);
    return score === undefined ? [] : [{ entry, score }];
  });
  return scored.sort((a, b) => a.score - b.score).map(({ entry }) => entry);
}

function scoreFor({ name, help, section }: HelpEntry, query: string): number | undefined {
  const marked = fuzzy(name, query);
  // Of names that begin alike the shorter one is nearer to what was typed.
  if (marked) return scoreOf(name, marked) * 100 + name.length;
  const text = `${help}\n${section ? textOf(section) : ''}`.toLowerCase();
  const at = text.indexOf(query.toLowerCase());
  return at < 0 ? undefined : kInText + at;
}

/** The word at an offset of a line of a script, with its dots; '' if there is none. */
export function wordAt(line: string, offset: number): string {
  for (const { 0: word, index } of line.matchAll(/[\p{L}_][\p{L}\d_]*(\.[\p{L}\d_]+)*/gu))
    if (index <= offset && offset <= index + word.length) return word;
  return '';
}
