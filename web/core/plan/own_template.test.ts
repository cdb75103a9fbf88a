import { expect, test } from 'vitest';
import type { PlanToolbox, SharedFile } from '../../protocol/messages';
import { faultOfName, workingScripts, type WantedTemplate } from './own_template';

const template = { kind: 'actor', help: '', icon: '', inputs: [], outputs: [], outcomes: [] };
const toolboxes = [
  { name: 'core', help: '', templates: [{ ...template, name: 'Wait', period_ms: 0 }] },
] as PlanToolbox[];
const files: SharedFile[] = [
  { path: 'a.aesl', events: [{ name: 'blink.start', value: 1 }], constants: [] },
  { path: 'b.aesl', events: [], constants: [] },
];
const wanted = (name: string, script = 'b.aesl#1'): WantedTemplate => ({
  name,
  script,
  kind: 'actor',
  help: '',
});

test('a name is one of plans, free in all toolboxes, and its events are free in the file', () => {
  expect(faultOfName(wanted('Blink'), toolboxes, files)).toBeNull();
  expect(faultOfName(wanted(''), toolboxes, files)).toBe('empty');
  expect(faultOfName(wanted('2nd'), toolboxes, files)).toBe('form');
  expect(faultOfName(wanted('a b'), toolboxes, files)).toBe('form');
  expect(faultOfName(wanted('Wait'), toolboxes, files)).toBe('taken');
  expect(faultOfName(wanted('Blink', 'a.aesl#2'), toolboxes, files)).toBe('event');
});

test('a plain script declares no events and does no work', () => {
  const part = (doc: string) => ({ doc, name: 'n', node: 1, file: doc });
  expect(workingScripts([part('a.aesl#1'), part('plain.aesl')])).toEqual([part('a.aesl#1')]);
});
