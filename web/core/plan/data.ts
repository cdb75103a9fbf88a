// Data flow: which variables feed the inputs of an element, and which its outputs write.

import type { Actor, PlanModel, Supervisor } from './model';
import { textOf } from './json';

export interface DataArrow {
  variable: string;
  element: string;
  /** Name of the input or output. */
  port: string;
  is: 'in' | 'out';
}

/** Names in a formula that are no strings, words of the language or functions. */
export function namesIn(formula: string): Set<string> {
  const bare = formula.replace(/"[^"]*"|'[^']*'/g, ' ');
  const names = new Set<string>();
  for (const match of bare.matchAll(/(?<![\w.])[A-Za-z_]\w*(?!\w|\s*\()/g)) names.add(match[0]);
  return names;
}

export function dataArrows(model: PlanModel, element: Actor | Supervisor): DataArrow[] {
  const arrows: DataArrow[] = [];
  for (const [port, formula] of Object.entries(element.inputs)) {
    const names = namesIn(textOf(formula));
    for (const { name } of model.variables)
      if (names.has(name)) arrows.push({ variable: name, element: element.name, port, is: 'in' });
  }
  for (const [port, target] of Object.entries(element.outputs))
    if (model.variables.some(({ name }) => name === target))
      arrows.push({ variable: textOf(target), element: element.name, port, is: 'out' });
  return arrows;
}
