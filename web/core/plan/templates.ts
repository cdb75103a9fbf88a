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
