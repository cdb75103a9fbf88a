// F5: runs what is on the screen, and says what does not run and what still does.

import { countsOf } from '../../core/findings';
import { isPlan, kLastPlan, planMeant, planName, runOrder } from '../../core/run_choice';
import { runStateOf } from '../../core/run_state';
import type { Studio } from '../../core/studio';
import { update } from '../../core/window_state';
import type { Doc, Node } from '../../protocol/messages';
import { timeOf } from '../parts/time_of';
import { text } from '../text';
import { freshFindings } from './problem_commands';
import { clockOf, keepState, projectOf, robotOf } from './looks';

const words = text.run.note;

export async function runRobot(studio: Studio): Promise<void> {
  const { doc } = studio.window.getState();
  note(studio, null);
  await studio.documents.flushAll();
  const meant = meantNow(studio);
  const plan = studio.topics.get('plan', {});
  const held = runStateOf(robotOf(studio), clockOf(studio), plan) === 'held';
  const order = runOrder(meant, plan, held, projectOf(studio)?.plan);
  const broken = meant === undefined ? 0 : errorsIn(studio, meant);
  // What runs or is paused goes on as it was started; only what would begin needs a plan without errors.
  const begins = order.command === 'plan.start' || (plan?.state !== 'running' && !held);
  if (meant !== undefined && broken > 0 && begins)
    return note(studio, doc, words.notStarted(planName(meant), broken, stillRuns(studio)));
  if (order.doc === undefined) await studio.send('run.start', {});
  else await studio.send('plan.start', { doc: order.doc });
  if (doc !== null && isPlan(doc) && meant === doc) keepState(studio, kLastPlan, doc);
  if (meant !== undefined && broken > 0)
    note(studio, doc, words.asStarted(planName(meant), broken));
  else void freshFindings(studio).then(() => tellOlder(studio, doc));
}

function meantNow(studio: Studio): Doc | undefined {
  const files = studio.topics.get('files', {})?.files ?? [];
  return planMeant({
    doc: studio.window.getState().doc,
    kept: studio.topics.get('state', {})?.values,
    project: projectOf(studio)?.plan,
    exists: (doc) => files.some((file) => file.path === doc),
  });
}

function errorsIn(studio: Studio, doc: Doc): number {
  return countsOf(studio.topics.get('findings', {})?.findings ?? [], doc).errors;
}

/** Nodes whose scripts have errors were not loaded: they run what they had, or nothing. */
function tellOlder(studio: Studio, doc: Doc | null): void {
  const broken = (robotOf(studio)?.nodes ?? []).filter(
    (node) => node.doc !== undefined && errorsIn(studio, node.doc) > 0,
  );
  if (broken.length > 0)
    note(studio, doc, broken.map((node) => words.script(node.name, has(node))).join(' '));
}

function has(node: Node): string | null {
  if (node.program === 'none' || node.program === 'unknown') return null;
  return node.loaded_wall ? timeOf(node.loaded_wall) : '';
}

function stillRuns(studio: Studio): string {
  const plan = studio.topics.get('plan', {});
  return plan?.state === 'running' && plan.doc !== undefined ? planName(plan.doc) : '';
}

/** Said in the document where the key was pressed, until it is dismissed or F5 is pressed again. */
function note(studio: Studio, doc: Doc | null, what = ''): void {
  update(studio.window, (draft) => void (draft.runNote = what ? { doc, text: what } : null));
}
