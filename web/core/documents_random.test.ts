// Two pages with two files each, as they are in a browser but for its window, at one server: links that are late
// and cut, restarts that lose what nobody has heard of, edits that are refused, files that change on disk, are
// renamed, deleted and made again, and edits that the server makes because a page asked. In the end all have the
// same texts, nothing that somebody typed is missing, and every wait has ended.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { ModelServer, Schedule } from './session/test_server';
import type { TextSession } from './session/text_session';
import { House, Line } from './test_house';
import { seeded } from './test_seeded';

/** Long ones are for ./dev; figures of the environment, so that one failure can be looked at. */
const usual = process.env['VAGUS_LONG'] === undefined ? 150 : 10_000;
const runs = Number(process.env['VAGUS_RUNS'] ?? usual);
const seed = Number(process.env['VAGUS_SEED'] ?? Math.floor(Math.random() * 2 ** 31));
const path = process.env['VAGUS_PATH'];
console.log(`random files: VAGUS_SEED=${seed} VAGUS_RUNS=${runs}`);

/** Of each file: no other one gets a name that somebody may still know it by. */
const kNames = [
  ['a', 'c', 'e'],
  ['b', 'd', 'f'],
];
const kFiles = 2;

type Edit = 'type' | 'delete' | 'undo' | 'redo';
type Act =
  | { do: Edit | 'flush' | 'made'; page: number; file: number; at: number; size: number }
  | { do: 'disk' | 'rename' | 'gone' | 'made again'; file: number; at: number }
  | { do: 'cut'; page: number }
  | { do: 'wait'; ms: number }
  | { do: 'restart' | 'lose' | 'forget' | 'refuse' };

const page = fc.nat(1);
const file = fc.nat(kFiles - 1);
const at = fc.nat(1000);
const on = <Name extends string>(...names: Name[]) => fc.constantFrom(...names);
const act: fc.Arbitrary<Act> = fc.oneof(
  {
    weight: 9,
    arbitrary: fc.record({
      do: on('type', 'type', 'delete', 'undo', 'redo', 'flush', 'made'),
      page,
      file,
      at,
      size: fc.integer({ min: 1, max: 4 }),
    }),
  },
  {
    weight: 4,
    arbitrary: fc.record({ do: on('disk', 'rename', 'rename', 'gone', 'made again'), file, at }),
  },
  { weight: 2, arbitrary: fc.record({ do: fc.constant('cut' as const), page }) },
  { weight: 3, arbitrary: fc.record({ do: fc.constant('wait' as const), ms: fc.nat(60) }) },
  { weight: 1, arbitrary: fc.record({ do: fc.constant('wait' as const), ms: fc.nat(6000) }) },
  { weight: 2, arbitrary: fc.record({ do: on('restart', 'lose', 'forget', 'refuse') }) },
);

class Game {
  readonly house = new House();
  readonly schedule = new Schedule();
  readonly lines: Line[];
  /** By page and file. */
  readonly sessions: TextSession[][] = [];
  readonly names = kNames.map(([first = '']) => first);
  readonly waits: { ended: boolean }[] = [];
  /** Every character that was typed is another one. */
  private next = 0x4e00;
  /** Somebody has deleted it, or brought it back: that it is there once is not sure. */
  readonly touched = new Set<string>();
  /** Taken by a server that ended before the page heard of it: if little of it is left, it comes twice. */
  readonly doubtful = new Set<string>();
  readonly typed: Set<string>[] = [];

  constructor(chance: number) {
    const random = seeded(chance);
    for (const name of this.names) {
      this.house.add(name, 'abcdefgh\nijklmnop\n');
      this.typed.push(new Set('abcdefghijklmnop'));
    }
    this.lines = [1, 2].map((number) => new Line(number, this.house, this.schedule, random));
  }

  /** All pages have opened all files. */
  async begin(): Promise<void> {
    for (const { documents } of this.lines) {
      const all = Promise.all(this.names.map((name) => documents.acquire(name).opened));
      let opened: Awaited<typeof all> | null = null;
      void all.then((there) => (opened = there));
      while (opened === null) {
        await this.schedule.advance(50);
        // The session is loaded when the first file is opened.
        await new Promise((done) => setTimeout(done));
      }
      this.sessions.push((await all).map(({ session }) => session));
    }
  }

  async play(act: Act): Promise<void> {
    switch (act.do) {
      case 'type':
      case 'delete':
      case 'undo':
      case 'redo':
        return this.edit(act.do, act);
      case 'flush':
        return this.flush(act.page, act.file);
      case 'cut':
        return this.lines[act.page]?.cut();
      case 'wait':
        return this.schedule.advance(act.ms);
      case 'restart':
      case 'lose':
        this.noteDoubtful();
        return this.house.restart({ loses: act.do === 'lose' });
      case 'forget':
        return this.house.texts.forEach((text) => text.forget());
      case 'refuse':
        return this.house.texts.forEach((text) => (text.refuses = 2));
      case 'made':
        return this.made(act);
      case 'disk': {
        const text = this.textOf(act.file);
        const from = act.at % (text.text.length + 1);
        text.journal(text.apply('disk', [{ from, to: from, text: this.letters(act.file, 2) }]));
        return;
      }
      case 'rename': {
        const before = this.nameOf(act.file);
        const to = kNames[act.file]?.[act.at % 3] ?? '';
        if (!this.house.files.get(before)?.gone) this.house.rename(before, to);
        return;
      }
      case 'gone':
      case 'made again':
        return this.house.setGone(this.nameOf(act.file), act.do === 'gone');
    }
  }

  nameOf(file: number): string {
    const name = this.house.nameNow(this.names[file] ?? '');
    this.names[file] = name;
    return name;
  }

  textOf(file: number): ModelServer {
    return this.house.files.get(this.nameOf(file))?.text ?? new ModelServer('');
  }

  /** A renamed variable or a fix, in the text as the server has it. */
  private made({ page, file, at, size }: { page: number; file: number; at: number; size: number }) {
    const text = this.textOf(file);
    const from = at % (text.text.length + 1);
    const to = Math.min(text.text.length, from + size);
    for (const one of text.text.slice(from, to)) this.touched.add(one);
    const changes = [{ from, to, text: this.letters(file, size) }];
    text.journal(text.apply(`for:${page + 1}`, changes));
  }

  private noteDoubtful(): void {
    for (const page of this.sessions)
      for (const [file, { confirmed }] of page.entries()) {
        const heard = new Set(confirmed.toString());
        for (const one of this.textOf(file).text) if (!heard.has(one)) this.doubtful.add(one);
      }
  }

  private flush(page: number, file: number): void {
    const wait = { ended: false };
    this.waits.push(wait);
    const end = () => (wait.ended = true);
    void this.lines[page]?.documents.flushOne(this.nameOf(file)).then(end, end);
  }

  async settle(): Promise<void> {
    this.house.texts.forEach((text) => (text.refuses = 0));
    await this.schedule.advance(20_000);
    for (const page of this.lines.keys())
      for (const file of this.names.keys()) this.flush(page, file);
    await this.schedule.advance(20_000);
  }

  private edit(what: Edit, { page, file, at, size }: Extract<Act, { size: number }>): void {
    const session = this.sessions[page]?.[file];
    if (!session) return;
    const before = new Set(session.text);
    const { length } = session.doc;
    const from = at % (length + 1);
    if (what === 'undo') session.undo();
    if (what === 'redo') session.redo();
    if (what === 'type') {
      const insert = this.letters(file, size);
      session.type({ changes: { from, insert }, at: this.schedule.now });
    }
    if (what === 'delete') {
      const to = Math.min(length, from + size);
      session.type({ changes: { from, to }, at: this.schedule.now });
    }
    const after = new Set(session.text);
    for (const one of before) if (!after.has(one)) this.touched.add(one);
  }

  private letters(file: number, count: number): string {
    let text = '';
    for (let i = 0; i < count; i++) text += String.fromCharCode(this.next++);
    for (const one of text) this.typed[file]?.add(one);
    return text;
  }
}

describe('files of two pages', () => {
  test('AreTheSameInTheEndUnderTheirNewNamesAndNothingIsLost', async () => {
    const property = fc.asyncProperty(
      fc.array(act, { maxLength: 40 }),
      fc.nat(),
      async (acts, chance) => {
        const game = new Game(chance);
        await game.begin();
        for (const one of acts) await game.play(one);
        await game.settle();
        expect(game.waits.filter(({ ended }) => !ended)).toEqual([]);
        for (const [page, { documents }] of game.lines.entries()) {
          expect(documents.isUnsent).toBe(false);
          for (const file of game.names.keys()) {
            const session = game.sessions[page]?.[file];
            expect(session?.text).toBe(game.textOf(file).text);
            expect((await documents.acquire(game.nameOf(file)).opened).session).toBe(session);
          }
        }
        for (const [file, letters] of game.typed.entries())
          for (const one of [...letters].filter((letter) => !game.touched.has(letter))) {
            const times = game.textOf(file).text.split(one).length - 1;
            expect(game.doubtful.has(one) ? Math.min(times, 1) : times).toBe(1);
          }
      },
    );
    const asked = { numRuns: runs, seed, endOnFailure: process.env['VAGUS_SEED'] === undefined };
    await fc.assert(property, path === undefined ? asked : { ...asked, path });
  }, 600_000);
});
