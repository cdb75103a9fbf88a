// Which template a name means in a plan: core first, then the toolboxes that the plan lists (P0).

import type { PlanTemplate, PlanToolbox } from '../../protocol/messages';

export type Toolboxes = readonly PlanToolbox[];

export interface Found {
  toolbox: string;
  template: PlanTemplate;
}

const kCore = 'core';

export function findTemplate(
  toolboxes: Toolboxes,
  listed: readonly string[],
  name: string,
  isSupervisor: boolean,
): Found | undefined {
  for (const wanted of [kCore, ...listed]) {
    const toolbox = toolboxes.find((one) => one.name === wanted);
    const template = toolbox?.templates.find(
      (one) => one.name === name && (one.kind === 'supervisor') === isSupervisor,
    );
    if (toolbox && template) return { toolbox: toolbox.name, template };
  }
  return undefined;
}

/** The toolbox whose template of that name a plan would get instead; null: it gets this one. */
export function hiddenBy(
  toolboxes: Toolboxes,
  listed: readonly string[],
  { toolbox, template }: Found,
): string | null {
  // One that is not listed yet comes last.
  const then = listed.includes(toolbox) ? listed : [...listed, toolbox];
  const first = findTemplate(toolboxes, then, template.name, template.kind === 'supervisor');
  return first && first.toolbox !== toolbox ? first.toolbox : null;
}

export interface Group {
  name: string;
  help: string;
  templates: readonly PlanTemplate[];
}

/** What a palette shows for what was typed: groups that have something that fits. */
export function matching(toolboxes: Toolboxes, typed: string): Group[] {
  const words = typed.trim().toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (toolbox: string, one: PlanTemplate) => {
    const all = `${toolbox} ${one.name} ${one.help}`.toLowerCase();
    return words.every((word) => all.includes(word));
  };
  return toolboxes
    .map(({ name, help, templates }) => ({
      name,
      help,
      templates: templates.filter((one) => fits(name, one)),
    }))
    .filter((group) => group.templates.length > 0);
}

/** What a plan can use of what fits to what was typed. */
export function usable(toolboxes: Toolboxes, listed: readonly string[], typed: string): Found[] {
  return matching(toolboxes, typed)
    .flatMap(({ name, templates }) => templates.map((template) => ({ toolbox: name, template })))
    .filter((found) => hiddenBy(toolboxes, listed, found) === null);
}
