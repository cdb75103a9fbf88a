// A JSON text taken apart without losing a character: every value with the blanks around it and its
// place, so that one member can change and all else stays as somebody wrote it.

export type Key = string | number;

export interface Tree {
  kind: 'scalar' | 'array' | 'object';
  /** Where it begins in the text that was read; -1: it is new. */
  at: number;
  /** Of a scalar, as it is written. */
  raw: string;
  parts: Part[];
  /** Blanks before the closing bracket. */
  tail: string;
}

/** An item or a member: before "key" between value after , */
export interface Part {
  before: string;
  key: string;
  rawKey: string;
  /** The colon and the blanks around it. */
  between: string;
  value: Tree;
  after: string;
}

/** The text must be JSON: the caller has parsed it. */
export function readTree(text: string): Tree {
  return new Reader(text).whole();
}

class Reader {
  private at = 0;
  constructor(private readonly text: string) {}

  whole(): Tree {
    this.blanks();
    return this.value();
  }

  private value(): Tree {
    const first = this.text[this.at];
    if (first === '{' || first === '[') return this.container(first === '{');
    const { at } = this;
    const raw = first === '"' ? this.string() : this.match(/[^\s,\]}]*/y);
    return { kind: 'scalar', at, raw, parts: [], tail: '' };
  }

  private container(isObject: boolean): Tree {
    const tree: Tree = {
      kind: isObject ? 'object' : 'array',
      at: this.at++,
      raw: '',
      parts: [],
      tail: '',
    };
    let before = this.blanks();
    while (this.at < this.text.length && !/[}\]]/.test(this.text[this.at] ?? '')) {
      const part = this.part(isObject, before);
      tree.parts.push(part);
      if (this.text[this.at] !== ',') break;
      this.at++;
      before = this.blanks();
    }
    const last = tree.parts.at(-1);
    tree.tail = last ? last.after : before;
    if (last) last.after = '';
    this.at++;
    return tree;
  }

  private part(isObject: boolean, before: string): Part {
    const rawKey = isObject ? this.string() : '';
    const between = isObject ? this.match(/\s*:\s*/y) : '';
    const value = this.value();
    const key = isObject ? (JSON.parse(rawKey) as string) : '';
    return { before, key, rawKey, between, value, after: this.blanks() };
  }

  private blanks(): string {
    return this.match(/\s*/y);
  }

  private string(): string {
    return this.match(/"(?:[^"\\]|\\.)*"/y);
  }

  private match(pattern: RegExp): string {
    pattern.lastIndex = this.at;
    const [found = ''] = pattern.exec(this.text) ?? [];
    this.at += found.length;
    return found;
  }
}

export function textOfTree(tree: Tree): string {
  if (tree.kind === 'scalar') return tree.raw;
  const parts = tree.parts.map(
    ({ before, rawKey, between, value, after }) =>
      before + rawKey + between + textOfTree(value) + after,
  );
  const [open, close] = tree.kind === 'object' ? ['{', '}'] : ['[', ']'];
  return open + parts.join(',') + tree.tail + close;
}

/** Whether its parts are in lines of their own. */
export function isOpen({ parts }: Tree): boolean {
  return parts[0]?.before.includes('\n') ?? false;
}

/** The number of the part of that key; -1: there is none. */
export function indexIn(tree: Tree, key: Key): number {
  if (typeof key === 'string')
    return tree.kind === 'object' ? tree.parts.findIndex((part) => part.key === key) : -1;
  return tree.kind === 'array' && key < tree.parts.length ? key : -1;
}

export function takePart(tree: Tree, index: number): Part | undefined {
  const [taken] = tree.parts.splice(index, 1);
  const [first] = tree.parts;
  // The first place keeps its blanks.
  if (taken && index === 0 && first) first.before = taken.before;
  if (!first) tree.tail = '';
  return taken;
}

/** `depth`: how many values are around this one. */
export function insertPart(tree: Tree, index: number, part: Part, depth: number): void {
  const { parts } = tree;
  const [first, second] = parts;
  part.after = '';
  if (!first) {
    const open = tree.kind === 'object' && depth <= 1;
    part.before = open ? '\n' + ' '.repeat(depth * 2 + 2) : tree.kind === 'object' ? ' ' : '';
    tree.tail = open ? '\n' + ' '.repeat(depth * 2) : part.before;
  } else if (index === 0) {
    part.before = first.before;
    first.before = second?.before ?? like(part.before);
  } else {
    part.before =
      parts[index]?.before ?? (second ? (parts.at(-1)?.before ?? '') : like(first.before));
  }
  parts.splice(index, 0, part);
}

// The blanks before the part behind another, by those before the other.
function like(before: string): string {
  return before.includes('\n') ? before : ' ';
}
