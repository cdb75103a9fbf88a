// Sub-plans: one is opened in a tab with a way back, chosen actors become one.

import { isExtracted, type WhyNot } from '../../../../core/plan/extract';
import { asSent } from '../../../../core/json_steps';
import { pathTo, subPlanDoc } from '../../../../core/plan/sub_plans';
import type { Doc } from '../../../../protocol/messages';
import type { Studio } from '../../../../core/studio';
import { revealDoc, toast, update } from '../../../../core/window_state';
import { drawWords } from '../words';
import type { ShownPlan } from '../plan_desk';

const words = drawWords.subPlans;

/** The document of the sub-plan that is chosen. */
export function chosenSubPlan({ board }: ShownPlan): Doc | null {
  const actor = board.actor(board.selected);
  return actor?.role === 'subplan' ? subPlanDoc(board.doc, actor.template) : null;
}

export function openSubPlan(studio: Studio, plan: ShownPlan): void {
  const doc = chosenSubPlan(plan);
  if (doc === null) return;
  const from = plan.board.doc;
  update(studio.window, (draft) => void (draft.callers = { ...draft.callers, [doc]: from }));
  revealDoc(studio.window, doc, null);
}

/** All of it or nothing: the new plan's file is there before this one changes. */
export async function extractChosen(studio: Studio, plan: ShownPlan): Promise<void> {
  const { board } = plan;
  const name = freeFileName(studio, board.doc, [...board.chosenActors][0] ?? '');
  const doc = folderOf(board.doc) + name;
  const made = board.extract({
    name: name.replace('.plan.json', ''),
    path: pathTo(board.doc, doc),
  });
  if (!isExtracted(made)) return toast(studio.window, 'note', sentence(made));
  await studio.send('file.new', { path: doc, kind: 'plan' });
  const { version } = await studio.send('doc.open', { doc });
  const steps = Object.entries(made.file).map(([key, value]) => ({
    do: 'set' as const,
    at: [key],
    value,
  }));
  await studio.send('doc.patch', { doc, version, steps: asSent(steps) });
  await studio.send('doc.save', { doc });
  board.commit(made.steps);
  board.select(made.name);
  plan.focus(made.name);
  toast(studio.window, 'note', words.made(name));
}

const folderOf = (doc: Doc) => doc.slice(0, doc.lastIndexOf('/') + 1);

function freeFileName(studio: Studio, beside: Doc, actor: string): string {
  const taken = new Set(studio.topics.get('files', {})?.files.map((one) => one.path));
  const base = actor.charAt(0).toUpperCase() + actor.slice(1);
  for (let number = 1; ; number++) {
    const name = `${base}${number === 1 ? '' : number}.plan.json`;
    if (!taken.has(folderOf(beside) + name)) return name;
  }
}

function sentence(not: WhyNot): string {
  return words.whyNot[not.why](not.names.join(', '));
}
