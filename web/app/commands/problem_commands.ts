import { editsByDoc, ordered, stepIndex } from '../../core/findings';
import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { revealDoc, update } from '../../core/window_state';
import type { Finding, Fix } from '../../protocol/messages';
import { text } from '../text';
import { drives } from './looks';

const titles = text.commands;

export function problemCommands(studio: Studio): Command[] {
  const some = () => findingsOf(studio).length > 0;
  return [
    {
      id: 'problem.next',
      title: titles['problem.next'],
      group: text.groups.go,
      keys: ['F4'],
      enabled: some,
      run: () => stepProblem(studio, 1),
    },
    {
      id: 'problem.previous',
      title: titles['problem.previous'],
      group: text.groups.go,
      keys: ['Shift+F4'],
      enabled: some,
      run: () => stepProblem(studio, -1),
    },
    {
      id: 'problem.fix',
      title: titles['problem.fix'],
      group: text.groups.edit,
      keys: ['Alt+Enter'],
      enabled: () => drives(studio) && fixable(studio) !== undefined,
      run: () => fixNext(studio),
    },
  ];
}

export function findingsOf(studio: Studio): Finding[] {
  return ordered(studio.topics.get('findings', {})?.findings ?? []);
}

export function showProblem(studio: Studio, index: number, focus = true): void {
  const finding = findingsOf(studio)[index];
  if (!finding) return;
  update(studio.window, (draft) => void (draft.problem = index));
  revealDoc(studio.window, finding.doc, finding.at, focus);
}

/** Sends the edits of a fix; each text first gets what was typed into it. */
export async function applyFix(studio: Studio, fix: Fix | undefined): Promise<void> {
  if (!fix) return;
  await studio.documents.flushAll();
  for (const [doc, edits] of editsByDoc(fix.edits)) {
    const { version } = await studio.send('doc.open', { doc });
    const changes = edits.map(({ from, to, text: inserted }) => ({ from, to, text: inserted }));
    await studio.send('doc.edit', { doc, version, changes });
  }
}

function stepProblem(studio: Studio, by: 1 | -1): void {
  showProblem(studio, stepIndex(findingsOf(studio).length, studio.window.getState().problem, by));
}

/** What is mended is shown, wherever the caret was. */
async function fixNext(studio: Studio): Promise<void> {
  const finding = fixable(studio);
  if (!finding) return;
  if (!isOnLine(studio, finding)) revealDoc(studio.window, finding.doc, finding.at);
  await applyFix(studio, finding.fixes[0]);
}

/** A problem with a fix: on the caret's line, else the one chosen in the list, else the first. */
function fixable(studio: Studio): Finding | undefined {
  const { problem } = studio.window.getState();
  const findings = findingsOf(studio);
  const chosen = findings[problem];
  const able = findings.filter((one) => one.fixes.length > 0);
  return (
    able.find((one) => isOnLine(studio, one)) ??
    (chosen && able.includes(chosen) ? chosen : able[0])
  );
}

function isOnLine(studio: Studio, { doc, at, end }: Finding): boolean {
  const { cursor } = studio.window.getState();
  return cursor?.doc === doc && cursor.line >= at.line && cursor.line <= end.line;
}
