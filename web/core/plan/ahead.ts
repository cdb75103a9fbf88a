// What an actor will be started with, while the plan is paused before it begins: nothing is taken yet.

import { shownFormula } from './edit';
import type { Actor } from './model';

export interface Ahead {
  name: string;
  formula: string;
  unit: string;
}

/** The formulas of its inputs, or what counts without one. */
export function inputsAhead(actor: Actor | undefined): Ahead[] {
  return (actor?.known?.inputs ?? []).flatMap(({ name, unit, default: otherwise }) => {
    const formula = shownFormula(actor?.inputs[name]) || shownFormula(otherwise);
    return formula === '' ? [] : [{ name, formula, unit }];
  });
}

/** "seconds = n * 20 s · n 3": with the values that the formulas name, as they are now. */
export function aheadText(ahead: readonly Ahead[], values: ReadonlyMap<string, string>): string {
  const formulas = ahead.map(({ name, formula, unit }) => `${name} = ${formula} ${unit}`.trim());
  const words = namedIn(ahead);
  const named = [...values].filter(([name]) => words.has(name));
  return [...formulas, ...named.map(([name, value]) => `${name} ${value}`)].join(' · ');
}

/** What the formulas name: variables, and functions. */
export function namedIn(ahead: readonly Ahead[]): ReadonlySet<string> {
  return new Set(ahead.flatMap(({ formula }) => formula.match(/[A-Za-z_]\w*/g) ?? []));
}
