// Two pages and a server, with links that are late, cut and doubled, restarts of the server that lose
// what nobody has heard of, edits that are refused, files that change on disk and conflicts there: in
// the end all have the same text, and nothing that somebody typed is lost.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Json, JsonStep } from '../../protocol/messages';
import { seeded } from '../test_seeded';
import { ModelPage, ModelServer, Schedule } from './test_server';
import type { TextSession } from './text_session';

/** 10,000 in ./dev; a figure of the environment, so that one failure can be looked at. */
const runs = Number(process.env['VAGUS_RUNS'] ?? 500);
const seed = Number(process.env['VAGUS_SEED'] ?? Math.floor(Math.random() * 2 ** 31));
const parameters = { numRuns: runs, seed, endOnFailure: process.env['VAGUS_SEED'] === undefined };
console.log(`random documents: VAGUS_SEED=${seed} VAGUS_RUNS=${runs}`);

type Act =
  | { do: 'type'; page: number; at: number; size: number }
  | { do: 'delete'; page: number; at: number; size: number }
  | { do: 'undo' | 'redo' | 'cut' | 'join' | 'flush'; page: number }
  | { do: 'wait'; ms: number }
  | { do: 'restart' | 'lose' | 'forget' | 'refuse' }
  | { do: 'conflict'; page: number }
  | { do: 'disk'; at: number };

const page = fc.nat(1);
const at = fc.nat(1000);
const act: fc.Arbitrary<Act> = fc.oneof(
  {
    weight: 6,
    arbitrary: fc.record({
      do: fc.constant('type'),
      page,
      at,
      size: fc.integer({ min: 1, max: 3 }),
    }),
  },
  {
    weight: 3,
    arbitrary: fc.record({
      do: fc.constant('delete'),
      page,
      at,
      size: fc.integer({ min: 1, max: 4 }),
    }),
  },
  {
    weight: 4,
    arbitrary: fc.record({ do: fc.constantFrom('undo', 'redo', 'cut', 'join', 'flush'), page }),
  },
  { weight: 4, arbitrary: fc.record({ do: fc.constant('wait'), ms: fc.nat(60) }) },
  {
    weight: 1,
    arbitrary: fc.record({ do: fc.constantFrom('restart', 'lose', 'forget', 'refuse') }),
  },
  { weight: 1, arbitrary: fc.record({ do: fc.constant('conflict'), page }) },
  { weight: 1, arbitrary: fc.record({ do: fc.constant('disk'), at }) },
);

class Game {
  readonly server = new ModelServer('abcdefgh\nijklmnop\n');
  readonly schedule = new Schedule();
  readonly pages: ModelPage[];
  readonly waits: { ended: boolean }[] = [];
  /** Every character that was typed is another one. */
  private next = 0x4e00;
  /** What somebody has deleted, or brought back: that it is there once is not sure. */
  readonly touched = new Set<string>();
  readonly typed = new Set<string>([...this.server.text].filter((one) => one !== '\n'));

  constructor(chance: number) {
    const random = seeded(chance);
    this.pages = ['A', 'B'].map(
      (name) => new ModelPage(name, this.server, this.schedule, () => random(20)),
    );
  }

  async play(act: Act): Promise<void> {
    switch (act.do) {
      case 'type':
      case 'delete':
      case 'undo':
      case 'redo':
        return this.edit(act);
      case 'cut':
        return this.pages[act.page]?.cut();
      case 'join':
        return this.pages[act.page]?.join();
      case 'flush':
        return this.flush(act.page);
      case 'wait':
        return this.schedule.advance(act.ms);
      case 'restart':
      case 'lose':
        this.pages.forEach((one) => one.cut());
        this.server.restart({ loses: act.do === 'lose' });
        return this.schedule.in(15, () => this.pages.forEach((one) => one.join()));
      case 'forget':
        return this.server.forget();
      case 'refuse':
        this.server.refuses = 2;
        return;
      case 'conflict': {
        // The file changed on disk, and that page chose it: its edits may be undone.
        for (const one of this.server.text) this.touched.add(one);
        const to = this.server.text.length;
        const by = `for:${this.pages[act.page]?.name}`;
        return this.onDisk(by, { from: 0, to, text: this.letters(5) });
      }
      case 'disk': {
        const from = act.at % (this.server.text.length + 1);
        return this.onDisk('disk', { from, to: from, text: this.letters(2) });
      }
    }
  }

  private onDisk(by: string, change: { from: number; to: number; text: string }): void {
    this.server.journal(this.server.apply(by, [change]));
  }

  flush(page: number): void {
    const wait = { ended: false };
    this.waits.push(wait);
    void this.pages[page]?.sync.flushed().then(() => (wait.ended = true));
  }

  async settle(): Promise<void> {
    this.pages.forEach((one) => one.join());
    this.server.refuses = 0;
    await this.schedule.advance(2000);
    this.pages.forEach((_one, index) => this.flush(index));
    await this.schedule.advance(2000);
  }

  private edit(act: Extract<Act, { page: number }>): void {
    const { session } = this.pages[act.page] ?? {};
    if (!session) return;
    const before = new Set(session.text);
    const { length } = session.doc;
    if (act.do === 'undo') session.undo();
    if (act.do === 'redo') session.redo();
    if (act.do === 'type') {
      const from = act.at % (length + 1);
      session.type({ changes: { from, insert: this.letters(act.size) }, at: this.schedule.now });
    }
    if (act.do === 'delete') {
      const from = act.at % (length + 1);
      const to = Math.min(length, from + act.size);
      session.type({ changes: { from, to }, at: this.schedule.now });
    }
    const after = new Set(session.text);
    for (const one of before) if (!after.has(one)) this.touched.add(one);
  }

  private letters(count: number): string {
    let text = '';
    for (let i = 0; i < count; i++) text += String.fromCharCode(this.next++);
    for (const one of text) this.typed.add(one);
    return text;
  }
}

describe('documents', () => {
  test('AllAreTheSameInTheEndAndNothingIsLost', async () => {
    const game = fc.asyncProperty(
      fc.array(act, { maxLength: 40 }),
      fc.nat(),
      async (acts, chance) => {
        const game = new Game(chance);
        for (const one of acts) await game.play(one);
        await game.settle();
        for (const { session, sync } of game.pages) {
          expect(session.text).toBe(game.server.text);
          expect(sync.isUnsent).toBe(false);
        }
        expect(game.waits.filter(({ ended }) => !ended)).toEqual([]);
        for (const one of game.typed)
          if (!game.touched.has(one)) expect(game.server.text.split(one).length - 1).toBe(1);
      },
    );
    await fc.assert(game, parameters);
  }, 600_000);

  test('UndoOfOnesOwnLeavesWhatTheOthersAloneHaveMade', async () => {
    const zone = fc.record({ page, zone: fc.nat(3), at, size: fc.nat(3), deletes: fc.boolean() });
    const game = fc.asyncProperty(
      fc.array(zone, { maxLength: 30 }),
      fc.nat(),
      async (acts, chance) => {
        const { pages, schedule, server } = zoned(chance);
        for (const one of acts) {
          editZone(pages[one.page], one, schedule.now);
          // Each is a step of its own.
          await schedule.advance(one.size * 400);
        }
        await schedule.advance(60_000);
        const theirs = zonesOf(server.text).filter((_one, index) => index % 2 === 1);
        while (pages[0]?.session.undo());
        await schedule.advance(60_000);
        expect(zonesOf(server.text).filter((_one, index) => index % 2 === 1)).toEqual(theirs);
        expect(zonesOf(server.text).filter((_one, index) => index % 2 === 0)).toEqual(kOwnZones);
        expect(pages.map(({ session }) => session.text)).toEqual([server.text, server.text]);
      },
    );
    await fc.assert(game, parameters);
  }, 600_000);

  test('UndoLosesNoCharacterOfOthersAlsoWhereBothTypedInOnePlace', async () => {
    const game = fc.asyncProperty(
      fc.array(act, { maxLength: 40 }),
      fc.nat(),
      async (acts, chance) => {
        const game = new Game(chance);
        const deleted = new Set<string>();
        const others = new Set<string>();
        for (const one of acts) {
          const shown = () => game.pages['page' in one ? one.page : 1]?.session.text ?? '';
          const before = shown();
          if (kPlainActs.has(one.do)) await game.play(one);
          const after = shown();
          if (one.do === 'delete')
            for (const letter of before) if (!after.includes(letter)) deleted.add(letter);
          if (one.do === 'type' && one.page === 1)
            for (const letter of after) if (!before.includes(letter)) others.add(letter);
        }
        await game.settle();
        while (game.pages[0]?.session.undo());
        await game.settle();
        for (const letter of others)
          if (!deleted.has(letter)) expect(game.server.text.split(letter).length - 1).toBe(1);
        expect(game.pages.map(({ session }) => session.text)).toEqual(
          game.pages.map(() => game.server.text),
        );
      },
    );
    await fc.assert(game, parameters);
  }, 600_000);

  test('StepsOfTwoDrawingsAndTheirUndoLeaveAFileThatParses', async () => {
    const game = fc.asyncProperty(
      fc.array(drawn, { maxLength: 25 }),
      fc.nat(),
      async (acts, chance) => {
        const random = seeded(chance);
        const server = new ModelServer(chance % 2 ? kWritten : kSaved);
        const schedule = new Schedule();
        const pages = ['A', 'B'].map(
          (name) => new ModelPage(name, server, schedule, () => random(20), 'json'),
        );
        for (const one of acts) {
          const { session } = pages[one.page] ?? {};
          if (session) draw(session, one, schedule.now);
          for (const other of pages) JSON.parse(other.session.text);
          await schedule.advance(one.wait);
        }
        await schedule.advance(5000);
        JSON.parse(server.text);
        expect(pages.map(({ session }) => session.text)).toEqual([server.text, server.text]);
        expect(pages.map(({ sync }) => sync.isUnsent)).toEqual([false, false]);
      },
    );
    await fc.assert(game, parameters);
  }, 600_000);
});

/** Acts whose letters are followed easily. */
const kPlainActs: ReadonlySet<Act['do']> = new Set([
  'type',
  'delete',
  'wait',
  'cut',
  'join',
  'disk',
]);

const kOwnZones = ['aaaa', 'cccc', 'eeee', 'gggg'];

function zoned(chance: number) {
  const random = seeded(chance);
  const server = new ModelServer('aaaa|bbbb|cccc|dddd|eeee|ffff|gggg|hhhh');
  const schedule = new Schedule();
  const pages = ['A', 'B'].map(
    (name) => new ModelPage(name, server, schedule, () => random(20) * 50),
  );
  return { server, schedule, pages };
}

const zonesOf = (text: string) => text.split('|');

/** Within one of the zones of the page, those of the other lie between. */
function editZone(
  page: ModelPage | undefined,
  one: { page: number; zone: number; at: number; size: number; deletes: boolean },
  now: number,
): void {
  if (!page) return;
  const zones = zonesOf(page.session.text);
  const index = one.zone * 2 + one.page;
  const start = zones.slice(0, index).reduce((sum, zone) => sum + zone.length + 1, 0);
  const { length } = zones[index] ?? '';
  const from = start + (one.at % (length + 1));
  const to = one.deletes ? Math.min(start + length, from + one.size) : from;
  page.session.type({ changes: { from, to, insert: one.deletes ? '' : 'xyz' }, at: now });
}

const kSaved =
  '{\n  "name": "P",\n  "actors": {\n    "a": { "in": { "s": 1 } },\n    "b": {}\n  },\n  "list": [1, 22, 333]\n}\n';
const kWritten = '{ "name" :"P","list":[1,22 ,333],\n\n"actors":{"a":{ "in":{"s":1}}, "b":{}}}';

interface Drawn {
  page: number;
  what: 'set' | 'add' | 'remove' | 'insert' | 'take' | 'item' | 'move' | 'undo' | 'redo' | 'type';
  at: number;
  value: number;
  wait: number;
}

const drawn: fc.Arbitrary<Drawn> = fc.record({
  page,
  what: fc.constantFrom(
    'set',
    'add',
    'remove',
    'insert',
    'take',
    'item',
    'move',
    'undo',
    'redo',
    'type',
  ),
  at,
  value: fc.nat(500),
  wait: fc.nat(60),
});

function draw(session: TextSession, { what, at, value }: Drawn, now: number): void {
  const file = JSON.parse(session.text) as { actors?: object; list?: Json[] };
  const names = Object.keys(file.actors ?? {});
  const name = names[at % Math.max(names.length, 1)] ?? 'a';
  const list = file.list ?? [];
  const index = at % Math.max(list.length, 1);
  const steps: Record<Exclude<Drawn['what'], 'undo' | 'redo' | 'type'>, JsonStep> = {
    set: { do: 'set', at: ['name'], value: `P${value}` },
    add: { do: 'set', at: ['actors', `n${at % 5}`], value: { in: { s: value } } },
    remove: { do: 'remove', at: ['actors', name] },
    insert: { do: 'insert', at: ['list', index], value },
    take: { do: 'remove', at: ['list', index] },
    item: { do: 'set', at: ['list', index], value },
    move: { do: 'move', at: ['list', index], to: 0 },
  };
  if (what === 'undo') session.undo();
  else if (what === 'redo') session.redo();
  else if (what === 'type') {
    // In the text beside: a digit in a name.
    const from = session.text.indexOf('"P') + 2;
    if (from > 1) session.type({ changes: { from, insert: String(value) }, at: now });
  } else {
    try {
      session.step([steps[what]], now);
    } catch {
      // There is no such thing at the moment.
    }
  }
}
