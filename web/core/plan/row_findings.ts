// Which findings of a plan belong to which row of a form: by the keys that lead to what is meant.

import type { Finding } from '../../protocol/messages';
import type { Keys } from './model';

/** Those that mean exactly this member of the file. */
export function findingsAt(findings: readonly Finding[], keys: Keys): Finding[] {
  return findings.filter((one) => same(one, keys) && one.keys?.length === keys.length);
}

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
