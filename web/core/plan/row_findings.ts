// Which findings of a plan belong to which row of a form: by the keys that lead to what is meant.

import type { Finding } from '../../protocol/messages';
import type { Keys } from './model';

/** Those that mean exactly this member of the file. */
export function findingsAt(findings: readonly Finding[], keys: Keys): Finding[] {
  return findings.filter((one) => same(one, keys) && one.keys?.length === keys.length);
}

/** What would help with a finding: an arrow from a state, an event or Start; a value for an input, or another formula. */
export type Wanted = { is: 'arrow' | 'value' | 'formula'; name: string };

/** null: something else is wrong, or the finding is none of a plan. */
export function wantedBy({ code, keys = [], severity }: Finding): Wanted | null {
  if (severity !== 'error') return null;
  const [part, name] = keys.slice(-2);
  if (kOfFormulas.includes(code) && keys.length >= 4 && part === 'in' && typeof name === 'string')
    return { is: 'formula', name };
  if (!kAsking.includes(code)) return null;
  if (keys[0] === 'start' && keys[1] === 'actor') return { is: 'arrow', name: '' };
  if (keys.length < 4 || typeof name !== 'string') return null;
  if (part === 'in') return { is: 'value', name };
  return part === 'states' || part === 'events' ? { is: 'arrow', name } : null;
}

/** Rules: an input without a value, a start, a state, an event that leads nowhere. */
const kAsking = ['P3', 'P15', 'P17', 'P18'];

/** Rules: a formula that cannot be read, one whose value does not fit. */
const kOfFormulas = ['P8', 'P11'];

const kRows = ['in', 'out', 'states', 'events', 'supervisors'];

/** Those of an element that no row of its form shows. */
export function findingsOfElement(findings: readonly Finding[], keys: Keys): Finding[] {
  return findings.filter((one) => same(one, keys) && !isOfRow(one, keys));
}

function same({ keys: found = [] }: Finding, keys: Keys): boolean {
  return found.length >= keys.length && keys.every((key, index) => found[index] === key);
}

function isOfRow({ keys = [] }: Finding, element: Keys): boolean {
  const part = keys[element.length];
  return keys.length > element.length + 1 && typeof part === 'string' && kRows.includes(part);
}
