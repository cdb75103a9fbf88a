import { describe, expect, test } from 'vitest';
import type { JsonStep } from '../../protocol/messages';
import { patch } from './json_patch';

const patched = (text: string, steps: JsonStep[], language = 'json') =>
  patch(text, language, steps).text;

// The same cases as src/serve/edit/json_patch_test.cpp.
describe('steps in the text of a JSON file', () => {
  const odd = '{ "a" :1,\n   "b":[1,2 ,3],"c":{"d":  true}}\n\n';
  const cases: [JsonStep, string][] = [
    [{ do: 'set', at: ['a'], value: 7 }, '{ "a" :7,\n   "b":[1,2 ,3],"c":{"d":  true}}\n\n'],
    [{ do: 'set', at: ['b', 1], value: 'x' }, '{ "a" :1,\n   "b":[1,"x" ,3],"c":{"d":  true}}\n\n'],
    [
      { do: 'set', at: ['c', 'd'], value: false },
      '{ "a" :1,\n   "b":[1,2 ,3],"c":{"d":  false}}\n\n',
    ],
    [{ do: 'remove', at: ['b', 0] }, '{ "a" :1,\n   "b":[2 ,3],"c":{"d":  true}}\n\n'],
    [{ do: 'remove', at: ['a'] }, '{ "b":[1,2 ,3],"c":{"d":  true}}\n\n'],
    [
      { do: 'insert', at: ['b', 3], value: 4 },
      '{ "a" :1,\n   "b":[1,2 ,3,4],"c":{"d":  true}}\n\n',
    ],
    [{ do: 'move', at: ['b', 0], to: 2 }, '{ "a" :1,\n   "b":[2 ,3,1],"c":{"d":  true}}\n\n'],
  ];
  test.each(cases)('OnlyTheMemberMeantChanges %j', (step, after) =>
    expect(patched(odd, [step])).toBe(after),
  );
  test('TheSavedFormStaysTheSavedForm', () => {
    const open = '{\n  "a": {\n    "b": [1, 2]\n  },\n  "c": 1.50\n}\n';
    expect(patched(open, [{ do: 'set', at: ['a', 'd'], value: { x: 1, y: [] } }])).toBe(
      '{\n  "a": {\n    "b": [1, 2],\n    "d": { "x": 1, "y": [] }\n  },\n  "c": 1.50\n}\n',
    );
    const long = 'x'.repeat(90);
    const broken = patched(open, [{ do: 'insert', at: ['a', 'b', 1], value: long }]);
    expect(broken).toBe(
      `{\n  "a": {\n    "b": [\n      1,\n      "${long}",\n      2\n    ]\n  },\n  "c": 1.50\n}\n`,
    );
    expect(patched(broken, [{ do: 'remove', at: ['a', 'b', 1] }])).toBe(open);
  });
  test('NewMembersGoWhereTheFormatHasThem', () => {
    const odd = '{"format": "vagus-world/1","robots":[]}';
    const robot = { at: [0, 1], type: 'thymio2', name: 't' };
    expect(
      patched(
        odd,
        [
          { do: 'insert', at: ['robots', 0], value: robot },
          { do: 'set', at: ['size'], value: [1, 1] },
        ],
        'world',
      ),
    ).toBe(
      '{"format": "vagus-world/1","size": [1, 1],"robots":[{ "name": "t", "type": "thymio2", "at": [0, 1] }]}',
    );
  });
  test('OtherIndentationsAreFollowed', () => {
    const wide = '{\n    "a": {\n        "b": 1\n    }\n}\n';
    expect(patched(wide, [{ do: 'set', at: ['a', 'c'], value: 2 }])).toBe(
      '{\n    "a": {\n        "b": 1,\n        "c": 2\n    }\n}\n',
    );
    const long = 'y'.repeat(90);
    expect(patched(wide, [{ do: 'set', at: ['a', 'c'], value: [1, long] }])).toBe(
      `{\n    "a": {\n        "b": 1,\n        "c": [\n          1,\n          "${long}"\n        ]\n    }\n}\n`,
    );
  });
  test('EmptyObjectsAndListsAreFilledAndEmptied', () => {
    expect(patched('{}\n', [{ do: 'set', at: ['a'], value: 1 }])).toBe('{\n  "a": 1\n}\n');
    expect(patched('{\n  "a": 1\n}\n', [{ do: 'remove', at: ['a'] }])).toBe('{}\n');
    expect(patched('[ ]', [{ do: 'insert', at: [0], value: [] }])).toBe('[[]]');
    expect(patched('[1]', [{ do: 'move', at: [0], to: 0 }])).toBe('[1]');
  });
  test('KeysInQuotesNumbersAndTextsAreKept', () => {
    const text = '{"a\\u0041": 1e3, "\\"": "\\u00e9\\\\", "z": -0.0}';
    expect(patched(text, [{ do: 'set', at: ['aA'], value: '"\n' }])).toBe(
      '{"a\\u0041": "\\"\\n", "\\"": "\\u00e9\\\\", "z": -0.0}',
    );
    expect(patched(text, [{ do: 'remove', at: ['"'] }])).toBe('{"a\\u0041": 1e3, "z": -0.0}');
    expect(patched('{"c":3, "a":1}', [{ do: 'move', at: ['a'], to: 0 }])).toBe('{"a":1, "c":3}');
  });
  const wrong: JsonStep[] = [
    { do: 'set', at: ['a', 1], value: 2 },
    { do: 'insert', at: ['a', 2], value: 2 },
    { do: 'set', at: ['a', 'x'], value: 2 },
    { do: 'set', at: [0], value: 2 },
    { do: 'set', at: ['a', 0, 'x'], value: 2 },
    { do: 'move', at: ['a', 0], to: 1 },
    { do: 'remove', at: ['b'] },
  ];
  test.each(wrong)('AStepThatDoesNotFitIsRefused %j', (step) =>
    expect(() => patched('{"a":[1]}', [step])).toThrow(),
  );
});
