// What a plan has that fits what was typed: names first, then templates, formulas and targets.

import { supervisorKey } from './arrows';
import { shownFormula } from './edit';
import { pillKey } from './board';
import { kStart, supervisorsOf, type Actor, type PlanModel, type Supervisor } from './model';

export interface Hit {
  key: string;
  name: string;
  /** What it is, or the formula that fits. */
  about: string;
}

/** More are not listed. */
export const kHitsMax = 50;

/** start: how the start is called on the screen. */
export function findInPlan(model: PlanModel, typed: string, start: string): Hit[] {
  const wanted = typed.trim().toLowerCase();
  if (wanted === '') return [];
  const ranked = hitsOf(model, start)
    .map((hit) => ({ hit, rank: rankOf(hit, wanted) }))
    .filter(({ rank }) => rank < kNoRank)
    .sort((a, b) => a.rank - b.rank);
  return ranked.slice(0, kHitsMax).map(({ hit, rank }) => ({
    key: hit.key,
    name: hit.name,
    about: rank < kInside ? hit.about : (hit.inside.find((one) => has(one, wanted)) ?? hit.about),
  }));
}

interface Place extends Hit {
  inside: string[];
}

const kInside = 3;
const kNoRank = 4;
const has = (text: string, wanted: string) => text.toLowerCase().includes(wanted);

function rankOf({ name, about, inside }: Place, wanted: string): number {
  if (name.toLowerCase().startsWith(wanted)) return 0;
  if (has(name, wanted)) return 1;
  if (has(about, wanted)) return 2;
  return inside.some((one) => has(one, wanted)) ? kInside : kNoRank;
}

function hitsOf(model: PlanModel, start: string): Place[] {
  return [
    {
      key: kStart,
      name: start,
      about: '',
      inside: model.first === null ? [] : [`→ ${model.first}`],
    },
    ...model.actors.map((one) => ({ ...placeOf(one), key: one.name })),
    ...supervisorsOf(model).map((one) => ({ ...placeOf(one), key: supervisorKey(one) })),
    ...model.variables.map(({ name, type }) => ({
      key: pillKey(name),
      name,
      about: type,
      inside: [],
    })),
  ];
}

function placeOf(element: Actor | Supervisor): Omit<Place, 'key'> {
  const { name, template, inputs, outputs, outcomes } = element;
  const fed = [...Object.entries(inputs), ...Object.entries(outputs)];
  return {
    name,
    about: template,
    inside: [
      ...fed.map(([port, value]) => `${port}: ${shownFormula(value)}`),
      ...outcomes.flatMap((one) => (one.target === null ? [] : `${one.name} → ${one.target}`)),
    ],
  };
}
