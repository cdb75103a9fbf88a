// F5: runs what is on the screen, and says what does not run and what still does.

import { countsOf } from '../../core/findings';
import { isPlan, planInRun, planMeant, planName, runOrder } from '../../core/run_choice';
import { runStateOf } from '../../core/run_state';
import type { Studio } from '../../core/studio';
import { toast, update } from '../../core/window_state';
import type { Doc, Finding, Node } from '../../protocol/messages';
import { timeOf } from '../parts/time_of';
import { text } from '../text';
import { freshFindings } from './problem_commands';
import { isPhone } from '../is_phone';
import { clockOf, projectOf, rememberPlan, robotOf } from './looks';

const words = text.run.note;

export async function runRobot(studio: Studio): Promise<void> {
  const { doc } = studio.window.getState();
  note(studio, null);
  // What was typed last is checked before it is judged.
  await studio.inTurn(freshFindings(studio), (findings, due) =>
    runChecked(studio, doc, findings, due),
  );
}

async function runChecked(
  studio: Studio,
  doc: Doc | null,
  findings: readonly Finding[],
  due: number | undefined,
): Promise<void> {
  const meant = meantNow(studio);
  const plan = studio.topics.get('plan', {});
  const held = runStateOf(robotOf(studio), clockOf(studio), plan) === 'held';
  const order = runOrder(meant, plan, held, projectOf(studio)?.plan);
  const broken = meant === undefined ? 0 : countsOf(findings, meant).errors;
  // What runs or is paused goes on as it was started; only what would begin needs a plan without errors.
  const begins = order.command === 'plan.start' || (plan?.state !== 'running' && !held);
  if (meant !== undefined && broken > 0 && begins)
    return note(studio, doc, words.notStarted(planName(meant), broken, stillRuns(studio)), [meant]);
  if (order.doc === undefined) await studio.send('run.start', {}, due);
  else await studio.send('plan.start', { doc: order.doc }, due);
  if (doc !== null && isPlan(doc) && meant === doc) rememberPlan(studio, doc);
  if (meant !== undefined && broken > 0)
    note(studio, doc, words.asStarted(planName(meant), broken), [meant]);
  else tellOlder(studio, doc, findings);
}

function meantNow(studio: Studio): Doc | undefined {
  const files = studio.topics.get('files', {})?.files ?? [];
  const meant = planMeant({
    doc: studio.window.getState().doc,
    kept: studio.topics.get('state', {})?.values,
    project: projectOf(studio)?.plan,
    exists: (doc) => files.some((file) => file.path === doc),
  });
  return planInRun(meant, studio.topics.get('plan', {}));
}

/** Nodes whose scripts have errors were not loaded: they run what they had, or nothing. */
function tellOlder(studio: Studio, doc: Doc | null, findings: readonly Finding[]): void {
  const broken = (robotOf(studio)?.nodes ?? []).filter(
    (node) => node.doc !== undefined && countsOf(findings, node.doc).errors > 0,
  );
  const said = broken.map((node) => words.script(node.name, has(node))).join(' ');
  if (said !== '')
    note(
      studio,
      doc,
      said,
      broken.flatMap((node) => node.doc ?? []),
    );
}

function has(node: Node): string | null {
  if (node.program === 'none' || node.program === 'unknown') return null;
  return node.loaded_wall ? timeOf(node.loaded_wall) : '';
}

function stillRuns(studio: Studio): string {
  const plan = studio.topics.get('plan', {});
  return plan?.state === 'running' && plan.doc !== undefined ? planName(plan.doc) : '';
}

/**
 * Said in the document where the key was pressed, until it is dismissed, F5 is pressed again, or the
 * documents that it is about have no errors any more; where no document is seen, for a moment.
 */
function note(studio: Studio, doc: Doc | null, said = '', about: readonly Doc[] = []): void {
  if (said !== '' && (doc === null || isPhone())) return toast(studio.window, 'warning', said);
  update(studio.window, (draft) => void (draft.runNote = said ? { doc, text: said, about } : null));
}
