// A page of docs/ as the help shows it: headings, paragraphs, lists, tables, examples. Reads the little of
// Markdown that those pages are written in.

export type Block =
  | { is: 'text'; text: string }
  | { is: 'list'; items: readonly string[] }
  | { is: 'table'; head: readonly string[]; rows: readonly (readonly string[])[] }
  | { is: 'code'; text: string };

export interface Section {
  title: string;
  blocks: readonly Block[];
}

/** The language of the examples; other code is for a terminal. */
const kExamples = 'aesl';

/** The parts below the headings of the second level; what stands above the first is left out. */
export function sectionsOf(page: string): Section[] {
  const lines = page.split('\n');
  const heads = lines.flatMap((line, index) => (line.startsWith('## ') ? [index] : []));
  return heads.map((from, index) => ({
    title: (lines[from] ?? '').replace(/^## (\d+\. )?/, ''),
    blocks: blocksOf(lines.slice(from + 1, heads[index + 1])),
  }));
}

function blocksOf(lines: readonly string[]): Block[] {
  const blocks: Block[] = [];
  // An example of what is wrong, said in the comment above it.
  let isWrong = false;
  for (let at = 0; at < lines.length;) {
    const line = lines[at] ?? '';
    const end = endOf(lines, at);
    const part = lines.slice(at, end);
    if (line.startsWith('<!--')) isWrong = line.startsWith('<!-- wrong');
    else if (line.startsWith('```')) {
      if (line === '```' + kExamples && !isWrong)
        blocks.push({ is: 'code', text: part.slice(1, -1).join('\n') });
    } else if (line.startsWith('|')) blocks.push(tableOf(part));
    else if (line.startsWith('- ')) {
      const items = part.join('\n').slice(2).split('\n- ');
      blocks.push({ is: 'list', items: items.map(onOneLine) });
    } else if (line.trim() !== '') blocks.push({ is: 'text', text: onOneLine(part.join('\n')) });
    at = end;
  }
  return blocks;
}

function onOneLine(text: string): string {
  return text.replaceAll(/\s*\n\s*/g, ' ');
}

/** Behind the last line of the block that begins there. */
function endOf(lines: readonly string[], from: number): number {
  const first = lines[from] ?? '';
  const isOver = (line: string) => line.trim() === '' || /^(```|\||<!--)/.test(line);
  if (first.trim() === '' || first.startsWith('<!--')) return from + 1;
  const rest = lines.slice(from + 1);
  const own = first.startsWith('```')
    ? rest.indexOf('```') + 1
    : rest.findIndex(first.startsWith('|') ? (line) => !line.startsWith('|') : isOver);
  return own < 0 ? lines.length : from + 1 + own;
}

function tableOf(lines: readonly string[]): Block {
  const cells = (line: string) =>
    line
      .split(/(?<!\\)\|/)
      .slice(1, -1)
      .map((cell) => cell.trim().replaceAll('\\|', '|'));
  return { is: 'table', head: cells(lines[0] ?? ''), rows: lines.slice(2).map(cells) };
}

export interface Piece {
  text: string;
  is: 'plain' | 'code' | 'strong' | 'emphasis';
}

/** A line of text in pieces: `code`, **strong**, *emphasis*; a link is its words. */
export function piecesOf(text: string): Piece[] {
  const shown = text.replace(/\[([^\]]+)\]\([^)]*\)/g, '$1');
  return shown
    .split(/(`[^`]+`|\*\*[^*]+\*\*|\*[^*\s][^*]*\*)/)
    .filter((one) => one !== '')
    .map((one) => {
      if (one.startsWith('`')) return { text: one.slice(1, -1), is: 'code' };
      if (one.startsWith('**')) return { text: one.slice(2, -2), is: 'strong' };
      if (/^\*.+\*$/.test(one)) return { text: one.slice(1, -1), is: 'emphasis' };
      return { text: one, is: 'plain' };
    });
}

export function examplesIn(sections: readonly Section[]): string[] {
  return sections.flatMap(({ blocks }) =>
    blocks.flatMap((block) => (block.is === 'code' ? [block.text] : [])),
  );
}

/** All that stands in a section as one text. */
export function textOf({ title, blocks }: Section): string {
  const texts = blocks.map((block) => {
    if (block.is === 'list') return block.items.join('\n');
    if (block.is === 'table')
      return [block.head, ...block.rows].map((row) => row.join(' ')).join('\n');
    return block.text;
  });
  return [title, ...texts].join('\n');
}
