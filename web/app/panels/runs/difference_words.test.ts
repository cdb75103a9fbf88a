// The lanes of a comparison as a person reads them.
import { expect, test } from 'vitest';
import { laneWords, recordedWords } from './difference_words';

test.each([
  ['/plan/trace', 'value', 'Plan'],
  ['/node/range/variables', 'watch.distance', 'Variables of range: watch.distance'],
  ['/world/poses robot/carbot', '', 'Place of carbot'],
  ['/vagus/check', 'plan', 'Checksum of the whole run: plan'],
  ['/robot/r/2/plan/trace', 'actor', 'r/2: Plan'],
  ['/robot/r/2/node/left/variables', 'a', 'r/2: Variables of left: a'],
  ['/robot/r', '', 'r'],
  ['end', '', 'End of the run'],
  ['/of/another/version', 'x', '/of/another/version: x'],
])('ALaneIsNamedInWords %s', (name, place, words) => {
  expect(laneWords(name, place)).toBe(words);
});

test.each([
  [
    '/plan/trace',
    { plan: 'W', kind: 'write', variable: 'far', value: 30, by: 'outside' },
    'far = 30, set by outside',
  ],
  [
    '/plan/trace',
    { kind: 'actor-start', actor: 'go', in: { speed: 20 } },
    'go begins with speed 20',
  ],
  [
    '/robot/r/plan/trace',
    { kind: 'actor-end', actor: 'go', state: 'Done', target: '@terminate' },
    'go ends with Done, which leads to terminate',
  ],
  ['/plan/trace', { kind: 'new', actor: 'go' }, 'kind new, actor go'],
  ['/bus/events', { node: 0, name: 'range.watch', args: [4, 300] }, 'range.watch(4, 300)'],
  ['/bus/events', { name: 'x' }, 'x()'],
  ['/node/range/variables', [300, 0], '300, 0'],
  ['/world/poses robot/c', { x: 1.451569, y: 0.6, angle: -62.86 }, 'x 1.452, y 0.600 m, -62.86°'],
  ['end', { t: 5, result: 'OK' }, 'OK, after 5 s'],
  ['/vagus/input', { do: 'set', value: 'walldist=45' }, 'set walldist=45'],
  ['/vagus/check', 'f7504b', 'f7504b'],
])('WhatWasRecordedIsToldInWords %s %j', (name, value, words) => {
  expect(recordedWords(name, JSON.stringify(value))).toBe(words);
});

test('WhatIsNoJsonStaysAsItIs', () => {
  expect(recordedWords('/plan/trace', '6 bytes')).toBe('6 bytes');
  // Cut off by the limit of the message.
  expect(recordedWords('/plan/trace', '{"plan":"W","ki')).toBe('{"plan":"W","ki');
});
