import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Json, JsonStep, PlanTemplate, PlanToolbox } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import { TextSession } from '../session/text_session';
import * as edit from './edit';
import { planModel, type PlanModel } from './model';
import { kPartMax, parsePart, partOf, partText, paste, type Part } from './part';

const bare = {
  help: '',
  icon: '',
  inputs: [],
  outputs: [],
  outcomes: [],
  period_ms: 0,
  starts: [],
};
const wait: PlanTemplate = { ...bare, name: 'Wait', kind: 'actor' };
const toolboxes: PlanToolbox[] = [{ name: 'core', help: '', templates: [wait] }];

const file: Json = {
  format: 'vagus-plan/1',
  name: 'P',
  configuration: { far: { type: 'float', initial: 3 }, old: { type: 'int' } },
  start: { actor: 'a' },
  actors: {
    a: { template: 'Wait', in: { seconds: 'far * far2 & "far"' }, states: { Done: 'b' } },
    b: {
      template: 'Wait',
      states: { Done: 'b' },
      supervisors: { s: { template: 'Timeout', events: { Timeout: 'a', More: 'b' } } },
    },
    c: { template: 'Wait', out: { end: 'far' } },
  },
  layout: { a: [0, 0], b: [240, 0] },
  x: { kept: [1] },
};
const model = planModel(file, toolboxes);
const after = (steps: JsonStep[]) => applySteps(file, steps).value as Record<string, Json>;
const text = (value: Json | undefined) => JSON.stringify(value);

describe('edits of a plan', () => {
  it('move in the layout, also where there is none', () => {
    expect(edit.placeSteps(file, 'c', { x: 8, y: 16 })).toEqual([
      { do: 'set', at: ['layout', 'c'], value: [8, 16] },
    ]);
    expect(edit.placeSteps({ name: 'P' }, 'c', { x: 8, y: 16 })).toEqual([
      { do: 'set', at: ['layout'], value: { c: [8, 16] } },
    ]);
  });

  it('connect states, events and the start, and take arrows away', () => {
    const [a, , c] = model.actors;
    const s = model.actors[1]?.supervisors[0];
    if (!a || !c || !s) throw new Error('the plan lacks something');
    expect(edit.connectSteps(file, c, 'Done', 'a')).toEqual([
      { do: 'set', at: ['actors', 'c', 'states'], value: { Done: 'a' } },
    ]);
    expect(edit.connectSteps(file, s, 'Timeout', '@ignore')).toEqual([
      { do: 'set', at: ['actors', 'b', 'supervisors', 's', 'events', 'Timeout'], value: '@ignore' },
    ]);
    expect(edit.connectSteps(file, '@start', '', 'b')).toEqual([
      { do: 'set', at: ['start', 'actor'], value: 'b' },
    ]);
    expect(edit.connectSteps(file, a, 'Done', null)).toEqual([
      { do: 'remove', at: ['actors', 'a', 'states', 'Done'] },
    ]);
    expect(edit.connectSteps(file, c, 'Done', null)).toEqual([]);
  });

  it('add an actor with a name of its own; the first one is where the plan begins', () => {
    const empty: Json = { format: 'vagus-plan/1', name: 'P', actors: {} };
    const found = { toolbox: 'drive', template: { ...wait, name: 'Turn' } };
    const none = planModel(empty, toolboxes);
    const { name, steps } = edit.addActor(empty, none, found, { x: 80, y: 80 });
    expect(name).toBe('turn');
    expect(applySteps(empty, steps).value).toEqual({
      format: 'vagus-plan/1',
      name: 'P',
      toolboxes: ['drive'],
      start: { actor: 'turn' },
      actors: { turn: { template: 'Turn' } },
      layout: { turn: [80, 80] },
    });
    expect(edit.freeName(model, 'a')).toBe('a2');
    expect(edit.freeName(model, 'a', new Set(['a2']))).toBe('a3');
  });

  it('remove an actor with its place and all arrows to it', () => {
    const removed = after(edit.removeActor(file, model, 'b'));
    expect(text(removed['actors'])).toBe(
      '{"a":{"template":"Wait","in":{"seconds":"far * far2 & \\"far\\""},"states":{}},' +
        '"c":{"template":"Wait","out":{"end":"far"}}}',
    );
    expect(text(removed['layout'])).toBe('{"a":[0,0]}');
    expect(after(edit.removeActor(file, model, 'a'))['start']).toEqual({});
  });

  it('rename an actor at its place, with its place and all arrows to it', () => {
    const renamed = after(edit.renameActor(file, model, 'b', 'go'));
    expect(text(renamed['actors'])).toBe(
      '{"a":{"template":"Wait","in":{"seconds":"far * far2 & \\"far\\""},"states":{"Done":"go"}},' +
        '"go":{"template":"Wait","states":{"Done":"go"},"supervisors":' +
        '{"s":{"template":"Timeout","events":{"Timeout":"a","More":"go"}}}},' +
        '"c":{"template":"Wait","out":{"end":"far"}}}',
    );
    expect(text(renamed['layout'])).toBe('{"a":[0,0],"go":[240,0]}');
    expect(after(edit.renameActor(file, model, 'a', 'z'))['start']).toEqual({ actor: 'z' });
  });

  it('rename a variable in formulas and outputs, not in texts and other names', () => {
    const renamed = after(edit.renameVariable(file, model, 'far', 'wide'));
    expect(Object.keys(renamed['configuration'] ?? {})).toEqual(['wide', 'old']);
    expect(edit.valueAt(renamed, ['actors', 'a', 'in', 'seconds'])).toBe('wide * far2 & "far"');
    expect(edit.valueAt(renamed, ['actors', 'c', 'out', 'end'])).toBe('wide');
  });

  it('copy actors with their supervisors and variables as text, and paste them with free names', () => {
    const chosen = { actors: new Set(['a', 'b']), supervisors: [] };
    const places: Record<string, number> = { a: 100, b: 340 };
    const part = partOf(file, model, chosen, (name) => ({ x: places[name] ?? 0, y: 50 }));
    if (!part) throw new Error('nothing was copied');
    expect(parsePart(partText(part))).toEqual(part);
    expect(Object.keys(part.configuration)).toEqual(['far']);
    const pasted = paste(file, model, part, { at: { x: 8, y: 200 }, owner: '@start' });
    expect(pasted.actors).toEqual(['a2', 'b2']);
    const now = after(pasted.steps);
    expect(edit.valueAt(now, ['actors', 'a2'])).toEqual({
      template: 'Wait',
      in: { seconds: 'far * far2 & "far"' },
      states: { Done: 'b2' },
    });
    // The event "More" led to b itself, "Timeout" to a: both are in the part.
    expect(edit.valueAt(now, ['actors', 'b2'])).toEqual({
      template: 'Wait',
      states: { Done: 'b2' },
      supervisors: { s2: { template: 'Timeout', events: { Timeout: 'a2', More: 'b2' } } },
    });
    expect(now['layout']).toEqual({ a: [0, 0], b: [240, 0], a2: [8, 200], b2: [248, 200] });
  });

  it('paste into another plan what it lacks; arrows to what is not there lead nowhere', () => {
    const other: Json = { format: 'vagus-plan/1', name: 'Q', actors: { b: { template: 'Wait' } } };
    const part: Part = {
      toolboxes: ['drive'],
      configuration: { far: { type: 'int' } },
      actors: { a: { template: 'Wait', states: { Done: 'gone', Lost: 'b', End: '@terminate' } } },
      supervisors: { s: { template: 'Timeout', events: { Timeout: 'a' } } },
      layout: new Map([['a', { x: 0, y: 0 }]]),
    };
    const pasted = paste(other, planModel(other, []), part, { at: { x: 16, y: 8 }, owner: 'b' });
    expect(applySteps(other, pasted.steps).value).toEqual({
      format: 'vagus-plan/1',
      name: 'Q',
      toolboxes: ['drive'],
      configuration: { far: { type: 'int' } },
      actors: {
        b: {
          template: 'Wait',
          supervisors: { s: { template: 'Timeout', events: { Timeout: 'a' } } },
        },
        a: { template: 'Wait', states: { Lost: 'b', End: '@terminate' } },
      },
      layout: { a: [16, 8] },
    });
  });

  it('take no other text for a part of a plan', () => {
    const named = (more: string) => `{"format": "vagus-plan-part/1"${more}}`;
    expect(parsePart('')).toBeNull();
    expect(parsePart('{"format": "vagus-plan/1"}')).toBeNull();
    expect(parsePart(named(','))).toBeNull();
    expect(parsePart(named(', "actors": [1]'))?.actors).toEqual({});
    expect(parsePart(named(', "actors": {"a": 1, "b": {}}'))?.actors).toEqual({ b: {} });
    const long = named(`, "x": "${'x'.repeat(kPartMax)}"`);
    expect(parsePart(long)).toBeNull();
  });

  it('write constants as numbers, all else as formulas', () => {
    expect(['3', '-0.5', 'true', '1.0', '0x3', '1e3', ' 7 '].map(edit.formulaJson)).toEqual([
      3,
      -0.5,
      true,
      '1.0',
      '0x3',
      '1e3',
      7,
    ]);
    expect(edit.feedSteps(file, ['actors', 'a'], 'seconds', ' ')).toEqual([
      { do: 'remove', at: ['actors', 'a', 'in', 'seconds'] },
    ]);
  });

  it('refuse names that plans cannot have', () => {
    expect(edit.whyNoName(model, 'a b', 'actor')).toBe('form');
    expect(edit.whyNoName(model, 'b', 'actor')).toBe('taken');
    expect(edit.whyNoName(model, 's', 'actor')).toBeNull();
    expect(edit.whyNoName(model, 'true', 'variable')).toBe('form');
  });
});

describe('undo and redo', () => {
  it('lead back to the same file, byte for byte', () => {
    const act = fc.record({ kind: fc.nat(6), a: fc.nat(5), b: fc.nat(5) });
    fc.assert(
      fc.property(fc.array(act, { maxLength: 12 }), fc.boolean(), (acts, chance) => {
        const session = new TextSession(JSON.stringify(file, null, chance ? 2 : 0), 'plan');
        const states = [session.text];
        for (const [index, { kind, a, b }] of acts.entries()) {
          const steps = stepsOf(JSON.parse(session.text) as Json, kind, a, b);
          const { value } = applySteps(JSON.parse(session.text) as Json, steps);
          if (steps.length === 0) continue;
          session.step(steps, index * 5000);
          expect(JSON.parse(session.text)).toEqual(value);
          if (session.text !== states.at(-1)) states.push(session.text);
        }
        for (const state of states.slice(0, -1).reverse()) {
          session.undo();
          expect(session.text).toBe(state);
        }
        for (const state of states.slice(1)) {
          session.redo();
          expect(session.text).toBe(state);
        }
      }),
      { numRuns: 1000 },
    );
  }, 120_000);
});

function copyOf(value: Json, now: PlanModel, names: string[]): Part {
  const chosen = { actors: new Set(names), supervisors: [] };
  const part = partOf(value, now, chosen, () => ({ x: 0, y: 0 }));
  if (!part) throw new Error('there is nothing to copy');
  return part;
}

function stepsOf(value: Json, kind: number, a: number, b: number): JsonStep[] {
  const now = planModel(value, toolboxes);
  const actor = now.actors[a % Math.max(1, now.actors.length)];
  const other = now.actors[b % Math.max(1, now.actors.length)];
  const found = { toolbox: 'core', template: wait };
  const at = { x: a * 8, y: b * 8 };
  if (!actor || !other || kind === 0) return edit.addActor(value, now, found, at).steps;
  switch (kind) {
    case 1:
      return edit.removeActor(value, now, actor.name);
    case 2:
      return edit.renameActor(value, now, actor.name, edit.freeName(now, 'other'));
    case 3:
      return edit.connectSteps(value, actor, 'Done', other.name);
    case 4:
      return edit.placeSteps(value, actor.name, at);
    case 5:
      return paste(value, now, copyOf(value, now, [actor.name, other.name]), {
        at,
        owner: '@start',
      }).steps;
    default:
      return edit.feedSteps(value, actor.keys, 'seconds', a > 2 ? String(b) : '');
  }
}
