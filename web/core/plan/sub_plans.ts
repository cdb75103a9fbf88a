// Plans that are actors of other plans: what they need and give, and how one names the other.

import type { Doc, Json, PlanInput, PlanTemplate } from '../../protocol/messages';
import { memberOf, tableOf, textOf } from './json';

/** A plan's file, by what its callers write. */
export type SubPlans = ReadonlyMap<string, PlanTemplate>;

const kStates = ['OK', 'Interrupted', 'Error'];

/** What callers see of a plan: its inputs and outputs are variables with that access (P25). */
export function subPlanTemplate(path: string, file: Json): PlanTemplate {
  const variables = Object.entries(tableOf(memberOf(file, 'configuration')));
  const seen = (access: string) =>
    variables.filter(([, one]) => [access, 'inout'].includes(textOf(memberOf(one, 'access'))));
  return {
    name: path,
    kind: 'actor',
    help: textOf(memberOf(file, 'help')),
    icon: '',
    inputs: seen('in').map(([name, one]) => inputOf(name, one)),
    outputs: seen('out').map(([name, one]) => ({ ...shown(name, one) })),
    outcomes: kStates.map((name) => ({ name, help: '' })),
    period_ms: 0,
  };
}

const types = ['bool', 'int', 'float', 'string', 'object'] as const;

function shown(name: string, variable: Json) {
  const type = types.find((one) => one === textOf(memberOf(variable, 'type'))) ?? ('any' as const);
  return {
    name,
    type,
    unit: textOf(memberOf(variable, 'unit')),
    help: textOf(memberOf(variable, 'help')),
  };
}

function inputOf(name: string, variable: Json): PlanInput {
  const initial = memberOf(variable, 'initial');
  return { ...shown(name, variable), ...(initial === undefined ? {} : { default: initial }) };
}

/** The document that a plan means by a path, which counts from the plan's own folder. */
export function subPlanDoc(of: Doc, path: string): Doc {
  const found: string[] = [];
  for (const part of [...of.split('/').slice(0, -1), ...path.split('/')])
    if (part === '..' && found.length > 0 && found.at(-1) !== '..') found.pop();
    else if (part !== '.' && part !== '') found.push(part);
  return found.join('/');
}

/** The other way round. */
export function pathTo(from: Doc, to: Doc): string {
  const here = from.split('/').slice(0, -1);
  const there = to.split('/');
  let same = 0;
  while (same < here.length && same < there.length - 1 && here[same] === there[same]) same++;
  return [...here.slice(same).map(() => '..'), ...there.slice(same)].join('/');
}
