import { deskFor } from '../../core/desk';
import { editsByDoc, ordered, sameFinding, stepIndex } from '../../core/findings';
import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { revealDoc, toast, update } from '../../core/window_state';
import type { Finding, Fix } from '../../protocol/messages';
import { text } from '../text';
import { drives } from './looks';

const titles = text.commands;

/** A check that takes longer is not waited for: what F5 sends then comes in time yet (limits.act_ms). */
const kCheckedWithinMs = 2000;

/** What helps where no edit of the text does: in a drawing. */
export interface FindingAct {
  label: string;
  run(): void;
}

export interface DrawnHelp {
  /** null: nothing helps but a fix. */
  actFor(finding: Finding): FindingAct | null;
  /** Its element is selected in the drawing that is used. */
  isChosen(finding: Finding): boolean;
}

/** Drawings bring it along: without one that was shown there is none. */
export const drawnHelpOf: (studio: Studio) => { help: DrawnHelp | null } = deskFor(() => ({
  help: null,
}));

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
      enabled: () => drives(studio),
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

/** A button of a finding: its fix, as it is for the text that is there now. */
export function pressFix(studio: Studio, finding: Finding, fix: Fix): void {
  const press = async () => {
    const now = sameFinding(finding, fix.label, await freshFindings(studio));
    // It has gone meanwhile: there is nothing left to fix.
    await applyFix(
      studio,
      now?.fixes.find((one) => one.label === fix.label),
    );
  };
  void press().catch((problem: unknown) => studio.tell(problem));
}

/** The first of its buttons, by the key of its row. */
export function fixProblem(studio: Studio, finding: Finding): void {
  const [fix] = finding.fixes;
  if (fix) return pressFix(studio, finding, fix);
  const act = drawnHelpOf(studio).help?.actFor(finding);
  if (!act) return toast(studio.window, 'note', text.problems.noFix);
  // After the key: what opens for it would take the rest of that press for its own, and close.
  studio.world.later(0, () => act.run());
}

/** What the checkers say of what is on the screen: what was typed last is sent and waited for. */
export async function freshFindings(studio: Studio): Promise<readonly Finding[]> {
  const versions = await studio.documents.flushAll();
  const answer = await studio.topics.until(
    'findings',
    {},
    (is) => [...versions].every(([doc, version]) => (is.versions[doc] ?? version) >= version),
    kCheckedWithinMs,
  );
  return answer?.findings ?? [];
}

/** Makes the edits of a fix of a text that the server has as it is here: taken back like one's own. */
async function applyFix(studio: Studio, fix: Fix | undefined): Promise<void> {
  if (!fix) return;
  for (const [doc, edits] of editsByDoc(fix.edits)) {
    const held = studio.documents.acquire(doc);
    const { session } = await held.opened;
    const changes = edits.map(({ from, to, text: insert }) => ({ from, to, insert }));
    session.type({ changes, at: Date.now() });
    held.release();
  }
}

function stepProblem(studio: Studio, by: 1 | -1): void {
  showProblem(studio, stepIndex(findingsOf(studio).length, studio.window.getState().problem, by));
}

/** What is fixed is shown, wherever the caret was. */
async function fixNext(studio: Studio): Promise<void> {
  const drawn = drawnHelpOf(studio).help;
  const finding = fixable(studio, ordered(await freshFindings(studio)), drawn);
  if (!finding) return toast(studio.window, 'note', text.problems.noFix);
  if (finding.fixes.length === 0) return drawn?.actFor(finding)?.run();
  if (!isOnLine(studio, finding)) revealDoc(studio.window, finding.doc, finding.at);
  await applyFix(studio, finding.fixes[0]);
}

/**
 * A problem that can be helped: of the element that is selected, on the caret's line, else the one
 * chosen in the list, else the first.
 */
function fixable(
  studio: Studio,
  findings: readonly Finding[],
  drawn: DrawnHelp | null,
): Finding | undefined {
  const { problem, doc } = studio.window.getState();
  const chosen = findings[problem];
  const able = findings.filter((one) => one.fixes.length > 0 || drawn?.actFor(one));
  return (
    able.find((one) => one.doc === doc && drawn?.isChosen(one)) ??
    able.find((one) => isOnLine(studio, one)) ??
    (chosen && able.includes(chosen) ? chosen : able[0])
  );
}

function isOnLine(studio: Studio, { doc, at, end }: Finding): boolean {
  const { cursor } = studio.window.getState();
  return cursor?.doc === doc && cursor.line >= at.line && cursor.line <= end.line;
}
