// Findings of the checkers: order, counts, the next one, and the edits that fix one.

import type { Doc, Edit, Finding } from '../protocol/messages';

export interface Counts {
  errors: number;
  warnings: number;
}

export function countsOf(findings: readonly Finding[], doc?: Doc): Counts {
  const counts = { errors: 0, warnings: 0 };
  for (const finding of findings) {
    if (doc !== undefined && finding.doc !== doc) continue;
    if (finding.severity === 'error') counts.errors++;
    else counts.warnings++;
  }
  return counts;
}

/** Errors first, then by document and place. */
export function ordered(findings: readonly Finding[]): Finding[] {
  return [...findings].sort(
    (a, b) =>
      rank(a) - rank(b) ||
      compare(a.doc, b.doc) ||
      a.at.line - b.at.line ||
      a.at.column - b.at.column,
  );
}

export function stepIndex(count: number, current: number, by: 1 | -1): number {
  if (count === 0) return -1;
  if (current < 0) return by === 1 ? 0 : count - 1;
  return (current + by + count) % count;
}

/** The edits of a fix by document, last place first, so that none moves another. */
export function editsByDoc(edits: readonly Edit[]): Map<Doc, Edit[]> {
  const found = new Map<Doc, Edit[]>();
  for (const edit of edits) found.set(edit.doc, [...(found.get(edit.doc) ?? []), edit]);
  for (const list of found.values()) list.sort((a, b) => a.from - b.from);
  return found;
}

/** The finding that was meant, in newer findings: of the same kind, with that fix, the nearest. */
export function sameFinding(
  meant: Finding,
  label: string | undefined,
  findings: readonly Finding[],
): Finding | undefined {
  const away = (one: Finding) => Math.abs(one.at.line - meant.at.line);
  return findings
    .filter(
      (one) =>
        one.doc === meant.doc &&
        one.code === meant.code &&
        one.fixes.some((fix) => fix.label === label),
    )
    .sort((a, b) => away(a) - away(b))[0];
}

function rank(finding: Finding): number {
  return finding.severity === 'error' ? 0 : 1;
}

function compare(a: string, b: string): number {
  return a < b ? -1 : a > b ? 1 : 0;
}
