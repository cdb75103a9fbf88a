import fc from 'fast-check';
import { expect, test } from 'vitest';
import type { Json } from '../protocol/messages';
import { mergePatch } from './merge_patch';

// The examples of RFC 7396, appendix A.
const cases: [Json, Json, Json][] = [
  [{ a: 'b' }, { a: 'c' }, { a: 'c' }],
  [{ a: 'b' }, { b: 'c' }, { a: 'b', b: 'c' }],
  [{ a: 'b' }, { a: null }, {}],
  [{ a: 'b', b: 'c' }, { a: null }, { b: 'c' }],
  [{ a: ['b'] }, { a: 'c' }, { a: 'c' }],
  [{ a: 'c' }, { a: ['b'] }, { a: ['b'] }],
  [{ a: { b: 'c' } }, { a: { b: 'd', c: null } }, { a: { b: 'd' } }],
  [{ a: [{ b: 'c' }] }, { a: [1] }, { a: [1] }],
  [
    ['a', 'b'],
    ['c', 'd'],
    ['c', 'd'],
  ],
  [{ a: 'b' }, ['c'], ['c']],
  [{ a: 'foo' }, null, null],
  [{ a: 'foo' }, 'bar', 'bar'],
  [{ e: null }, { a: 1 }, { e: null, a: 1 }],
  [[1, 2], { a: 'b', c: null }, { a: 'b' }],
  [{}, { a: { bb: { ccc: null } } }, { a: { bb: {} } }],
];

test('MergePatchDoesWhatTheRfcSays', () => {
  for (const [value, patch, after] of cases) expect(mergePatch(value, patch)).toEqual(after);
});

test('WhatAPatchDoesNotTouchKeepsItsIdentity', () => {
  const value = { nodes: [{ id: 1 }], clock: { t: 1 } };
  const after = mergePatch(value, { clock: { t: 2 } }) as typeof value;
  expect(after.nodes).toBe(value.nodes);
  expect(value.clock.t).toBe(1);
});

test('NoPatchReachesAPrototype', () => {
  const patch = JSON.parse('{"__proto__": {"bad": 1}}') as Json;
  mergePatch({}, patch);
  expect(({} as Record<string, unknown>)['bad']).toBeUndefined();
});

test('ApplyingAPatchTwiceIsApplyingItOnce', () => {
  fc.assert(
    fc.property(fc.jsonValue(), fc.jsonValue(), (value, patch) => {
      const once = mergePatch(value as Json, patch as Json);
      expect(mergePatch(once, patch as Json)).toEqual(once);
    }),
  );
});
