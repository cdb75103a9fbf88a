// What the palette gives to a canvas: the name of a template with that of its toolbox.

import type { PlanTemplate, PlanToolbox } from '../../../protocol/messages';
import type { Found } from '../../../core/plan/templates';

export const kTemplateData = 'application/x-vagus-template';

export function dragged(toolbox: string, template: PlanTemplate): string {
  return `${toolbox}.${template.name}`;
}

export function foundIn(toolboxes: readonly PlanToolbox[], text: string): Found | undefined {
  for (const { name, templates } of toolboxes)
    for (const template of templates)
      if (dragged(name, template) === text) return { toolbox: name, template };
  return undefined;
}
