// The compact type language of protocol.json, as a tree. Used by the generator and by the check of
// what arrives, so that both read the same words.

export type Shape =
  | { is: 'text' | 'number' | 'bool' | 'json' }
  | { is: 'word'; words: string[] }
  | { is: 'list' | 'table'; of: Shape }
  | { is: 'named'; name: string };

export interface Field {
  shape: Shape;
  optional: boolean;
  help: string;
}

const basic: Record<string, Shape> = {
  text: { is: 'text' },
  line: { is: 'text' },
  int: { is: 'number' },
  number: { is: 'number' },
  bool: { is: 'bool' },
  json: { is: 'json' },
};

/** Reads "line(64)? -- what it is". */
export function readField(source: string): Field {
  const cut = source.indexOf(' -- ');
  const type = (cut < 0 ? source : source.slice(0, cut)).trim();
  const optional = type.endsWith('?');
  return {
    shape: readShape(optional ? type.slice(0, -1) : type),
    optional,
    help: cut < 0 ? '' : source.slice(cut + 4),
  };
}

export function readShape(type: string): Shape {
  const inner = /^([[{])(.*);\s*\d+\s*[\]}]$/s.exec(type);
  if (inner) return { is: inner[1] === '[' ? 'list' : 'table', of: readShape(inner[2] ?? '') };
  const [, name = '', rest] = /^(\w+)(?:\((.*)\))?$/.exec(type) ?? [];
  if (name === 'word') return { is: 'word', words: (rest ?? '').split('|') };
  const found = basic[name];
  if (found) return found;
  if (/^[A-Z]/.test(name)) return { is: 'named', name };
  throw new Error(`protocol.json: "${type}" is no type`);
}
