import type { PlanLevel } from '../../../protocol/messages';
import type { Command } from '../../../core/registry';
import type { Studio } from '../../../core/studio';
import { countsOf } from '../../../core/findings';
import { kindOf } from '../../documents';
import { text } from '../../text';
import { revealElement } from './reveal_element';
import { drives, mayAct, projectOf, rememberPlan } from '../../commands/looks';

const titles = text.commands;
const group = text.groups.run;

/** The plan alone; the whole robot has the run commands. */
export function planCommands(studio: Studio): Command[] {
  const state = () => studio.topics.get('plan', {})?.state ?? 'none';
  const may = () => mayAct(studio) && projectOf(studio) !== null;
  const goes = () => state() === 'running' || state() === 'paused';
  const make = (
    id: 'plan.pause' | 'plan.continue' | 'plan.step' | 'plan.stop',
    enabled: () => boolean,
  ): Command => ({
    id,
    title: titles[id],
    group,
    enabled,
    run: async () => void (await studio.sendInTurn(id, {})),
  });
  const held = (id: 'plan.held.step' | 'plan.held.go' | 'plan.held.drop'): Command => ({
    id,
    title: titles[id],
    group,
    enabled: () => may() && state() === 'paused',
    run: async () => void (await studio.sendInTurn(id, {})),
  });
  return [
    {
      id: 'plan.start',
      title: titles['plan.start'],
      group,
      enabled: () => may() && !goes() && planToStart(studio) !== undefined,
      async run() {
        const doc = planToStart(studio);
        const started = await studio.inTurn(studio.documents.flushAll(), (_, due) =>
          studio.send('plan.start', doc === undefined ? {} : { doc }, due),
        );
        if (started !== null) rememberPlan(studio, doc);
      },
    },
    make('plan.pause', () => may() && state() === 'running'),
    make('plan.continue', () => may() && state() === 'paused'),
    make('plan.step', () => may() && goes()),
    make('plan.stop', () => drives(studio) && goes()),
    held('plan.held.step'),
    held('plan.held.go'),
    held('plan.held.drop'),
    {
      id: 'plan.show',
      title: titles['plan.show'],
      group: text.groups.go,
      keys: ['Alt+F12'],
      enabled: () => activeActor(studio) !== undefined,
      run() {
        const level = activeActor(studio);
        if (level) revealElement(studio, level.doc, level.actor);
      },
    },
  ];
}

/** The innermost plan that runs with an active actor. */
function activeActor(studio: Studio): PlanLevel | undefined {
  const plan = studio.topics.get('plan', {});
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  return goes ? plan.levels.findLast((level) => level.actor !== '') : undefined;
}

/** The plan that is looked at, else that of the project; none with errors. */
function planToStart(studio: Studio): string | undefined {
  const { doc } = studio.window.getState();
  const plan = doc !== null && kindOf(doc) === 'plan' ? doc : projectOf(studio)?.plan;
  const findings = studio.topics.get('findings', {})?.findings ?? [];
  return plan !== undefined && countsOf(findings, plan).errors === 0 ? plan : undefined;
}
