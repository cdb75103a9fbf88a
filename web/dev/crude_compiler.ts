// A development tool: guesses, from the text alone, what the real compiler would say of a script.
// Good enough to look at the pages; it is not shipped.

import type { Doc, Finding, Handler, Place, Suggestion } from '../protocol/messages';

export interface Crude {
  findings: Finding[];
  handlers: Handler[];
  codeLines: number[];
  words: number;
  variables: number;
}

const natives = [
  'drive.move',
  'drive.turn',
  'drive.curve',
  'drive.steer',
  'drive.brake',
  'drive.pause',
  'drive.resume',
  'math.copy',
  'math.fill',
  'math.sin',
  'math.cos',
  'math.muldiv',
];
const keywords = [
  'if',
  'then',
  'else',
  'elseif',
  'end',
  'while',
  'do',
  'for',
  'in',
  'step',
  'onevent',
  'sub',
  'callsub',
  'call',
  'emit',
  'var',
  'const',
  'when',
  'return',
  'and',
  'or',
  'not',
  'abs',
];

export function crudeCompile(doc: Doc, text: string): Crude {
  const lines = text.split('\n');
  const out: Crude = { findings: [], handlers: [], codeLines: [], words: 0, variables: 34 };
  let offset = 0;
  lines.forEach((line, index) => {
    const code = line.replace(/#.*/, '');
    const header = /^\s*(onevent|sub)\s+([\w.]+)/.exec(code);
    if (header)
      out.handlers.push({
        kind: header[1] === 'sub' ? 'sub' : 'event',
        name: header[2] ?? '',
        line: index + 1,
        words: 0,
      });
    else if (code.trim() && !/^\s*(const|end)\b/.test(code)) out.codeLines.push(index + 1);
    if (/^\s*var\b/.test(code)) out.variables += Number(/\[(\d+)\]/.exec(code)?.[1] ?? 1);
    const words = Math.ceil(code.trim().length / 7);
    const last = out.handlers.at(-1);
    if (last) last.words += words;
    out.words += words;
    findIn(doc, code, index + 1, offset, out.findings);
    offset += line.length + 1;
  });
  return out;
}

function findIn(doc: Doc, code: string, line: number, offset: number, out: Finding[]): void {
  const single = /\b(?:if|while)\b[^=]*[^=!<>]( *)(=)(?!=)/.exec(code);
  if (single) {
    const at = single.index + single[0].length - 1;
    out.push(
      finding(
        doc,
        line,
        at,
        at + 1,
        'error',
        'EXPECTING',
        'expected “then” behind the condition, found “=”; write “==” to compare',
        [
          {
            label: 'Write “==”',
            edits: [{ doc, from: offset + at, to: offset + at + 1, text: '==' }],
          },
        ],
      ),
    );
  }
  const than = /\bthan\b/.exec(code);
  if (than) {
    out.push(
      finding(
        doc,
        line,
        than.index,
        than.index + 4,
        'error',
        'EXPECTING',
        'expected “then” behind the condition of “if”, found “than”; put “then” before the statements',
        [
          {
            label: 'Write “then”',
            edits: [{ doc, from: offset + than.index, to: offset + than.index + 4, text: 'then' }],
          },
        ],
      ),
    );
  }
  const unused = /\bvar (unused\w*)/.exec(code);
  if (unused) {
    const at = unused.index + 4;
    out.push(
      finding(
        doc,
        line,
        at,
        at + (unused[1] ?? '').length,
        'warning',
        'UNUSED',
        `“${unused[1]}” is never read`,
        [],
      ),
    );
  }
}

function finding(
  doc: Doc,
  line: number,
  from: number,
  to: number,
  severity: 'error' | 'warning',
  code: string,
  what: string,
  fixes: Finding['fixes'],
): Finding {
  return {
    doc,
    severity,
    code,
    at: { line, column: from + 1 },
    end: { line, column: to + 1 },
    what,
    fixes,
  };
}

export function wordAt(text: string, at: Place): { word: string; from: Place; to: Place } {
  const line = text.split('\n')[at.line - 1] ?? '';
  let from = at.column - 1;
  let to = from;
  while (from > 0 && /[\w.]/.test(line[from - 1] ?? '')) from--;
  while (to < line.length && /[\w.]/.test(line[to] ?? '')) to++;
  return {
    word: line.slice(from, to),
    from: { line: at.line, column: from + 1 },
    to: { line: at.line, column: to + 1 },
  };
}

export function suggestions(text: string, events: string[]): Suggestion[] {
  const variables = [...text.matchAll(/^\s*var\s+([\w.]+)/gm)].map((match) => match[1] ?? '');
  const constants = [...text.matchAll(/^\s*const\s+([\w.]+)/gm)].map((match) => match[1] ?? '');
  const of =
    (kind: Suggestion['kind'], detail: string, help: string) =>
    (label: string): Suggestion => ({ label, kind, detail, help, insert: label });
  return [
    ...variables.map(of('variable', 'of the script', '')),
    ...['event.args', 'event.source', 'wheel.front.speed', 'wheel.rear.speed', 'odometry.x'].map(
      of('variable', 'of the node', 'A variable of the node.'),
    ),
    ...constants.map(of('constant', 'constant', '')),
    ...events.map(of('event', 'event of the project', 'Goes to all nodes.')),
    ...natives.map(of('native', '(a, b)', 'A function of the node.')),
    ...keywords.map(of('keyword', '', '')),
  ];
}
