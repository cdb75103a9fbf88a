// Makes a template of one's own, puts one into the plan that is looked at, and opens the script where
// it is filled in.

import type { WantedTemplate } from '../../../core/plan/own_template';
import { kStart } from '../../../core/plan/model';
import type { Found } from '../../../core/plan/templates';
import type { Studio } from '../../../core/studio';
import { revealDoc, toast } from '../../../core/window_state';
import { words } from './words';
import { planDeskOf } from '../../views/plan/plan_desk';

/** Toolboxes are read again within a moment. */
const kKnownWithinMs = 5000;

export async function newTemplate(studio: Studio, wanted: WantedTemplate): Promise<void> {
  const { toolbox, at } = await studio.change('template.new', wanted);
  const found = await known(studio, toolbox, wanted.name);
  if (found) addToPlan(studio, found);
  toast(studio.window, 'ok', words.made(wanted.name));
  revealDoc(studio.window, wanted.script, at);
}

async function known(studio: Studio, toolbox: string, name: string): Promise<Found | undefined> {
  const value = await studio.topics.until(
    'templates',
    {},
    (now) =>
      now.toolboxes.some(
        (one) => one.name === toolbox && one.templates.some((template) => template.name === name),
      ),
    kKnownWithinMs,
  );
  const template = value?.toolboxes
    .find((one) => one.name === toolbox)
    ?.templates.find((one) => one.name === name);
  return template && { toolbox, template };
}

/** In the middle of the plan that is looked at; a supervisor under what is chosen, else the start. */
function addToPlan(studio: Studio, found: Found): void {
  const { shown } = planDeskOf(studio);
  if (!shown) return;
  const { board } = shown;
  if (found.template.kind !== 'supervisor') return void board.addActor(found, shown.middle());
  const owner = board.actor(board.selected)?.name ?? board.supervisor(board.selected)?.owner;
  board.addSupervisor(found, owner ?? kStart);
}
