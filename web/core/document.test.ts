import { ChangeSet } from '@codemirror/state';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { CommandError } from './connection';
import { SharedDocument, type DocTopic } from './document';

/** A server with one text; answers wait until the test lets them go. */
class Server {
  version = 1;
  by = 0;
  waiting: (() => void)[] = [];
  constructor(public text: string) {}

  edit(
    client: number,
    version: number,
    changes: { from: number; to: number; text: string }[],
  ): Promise<number> {
    return this.answer(() => {
      if (version !== this.version)
        throw new CommandError({ code: 'conflict', what: 'another version' });
      this.change(client, changes);
      return this.version;
    });
  }

  change(client: number, changes: { from: number; to: number; text: string }[]): void {
    for (const one of [...changes].sort((a, b) => b.from - a.from))
      this.text = this.text.slice(0, one.from) + one.text + this.text.slice(one.to);
    this.version++;
    this.by = client;
  }

  get topic(): DocTopic {
    return { version: this.version, text: this.text, by: this.by, unsaved: true, gone: false };
  }

  answer<T>(make: () => T): Promise<T> {
    return new Promise((resolve, reject) => {
      this.waiting.push(() => {
        try {
          resolve(make());
        } catch (error) {
          reject(error instanceof Error ? error : new Error('odd'));
        }
      });
    });
  }
}

/** A page: what stands on its screen, and the document behind it. */
class Page {
  screen: string;
  readonly shared: SharedDocument;
  constructor(
    readonly number: number,
    server: Server,
  ) {
    this.screen = server.text;
    this.shared = new SharedDocument(
      {
        open: () =>
          server.answer(() => ({
            text: server.text,
            version: server.version,
            language: 'aesl' as const,
            unsaved: true,
          })),
        edit: (version, changes) => server.edit(number, version, changes),
      },
      { text: server.text, version: server.version },
    );
    this.shared.remote.on((changes) => {
      this.screen = applied(this.screen, changes);
    });
  }

  type(at: number, remove: number, insert: string): void {
    const from = Math.min(at, this.screen.length);
    const to = Math.min(from + remove, this.screen.length);
    const change = ChangeSet.of({ from, to, insert }, this.screen.length);
    this.screen = applied(this.screen, change);
    this.shared.edit(change);
  }
}

function applied(text: string, change: ChangeSet): string {
  let out = '';
  let last = 0;
  change.iterChanges((from, to, _a, _b, inserted) => {
    out += text.slice(last, from) + inserted.toString();
    last = to;
  }, true);
  return out + text.slice(last);
}

const idle = () => new Promise((resolve) => setTimeout(resolve));

async function settle(server: Server, pages: Page[]): Promise<void> {
  for (let round = 0; round < 200; round++) {
    for (const page of pages) page.shared.told(server.topic);
    const next = server.waiting.shift();
    next?.();
    await idle();
    if (server.waiting.length === 0 && pages.every((page) => !page.shared.waits)) break;
  }
  for (const page of pages) page.shared.told(server.topic);
}

test('WhatIsTypedReachesTheServerInOneMessageWhileOneIsUnderWay', async () => {
  const server = new Server('abc');
  const page = new Page(1, server);
  page.type(3, 0, 'd');
  // At once: there is nothing to wait for.
  expect(server.waiting).toHaveLength(1);
  page.type(4, 0, 'e');
  page.type(5, 0, 'f');
  await idle();
  expect(server.waiting).toHaveLength(1);
  await settle(server, [page]);
  expect(server.text).toBe('abcdef');
  expect(server.version).toBe(3);
});

test('AChangeOfAnotherIsWovenIntoWhatIsBeingTyped', async () => {
  const server = new Server('one two');
  const page = new Page(1, server);
  page.type(7, 0, ' three');
  server.change(0, [{ from: 0, to: 3, text: 'ONE' }]);
  await settle(server, [page]);
  expect(server.text).toBe('ONE two three');
  expect(page.screen).toBe('ONE two three');
});

test('AnEditThatTheServerTookIsNotDoneTwiceWhenItsAnswerWasLost', async () => {
  const server = new Server('a');
  const page = new Page(1, server);
  page.type(1, 0, 'b');
  await idle();
  // The server takes it, but says "conflict": a repeated command met a restarted server.
  server.change(1, [{ from: 1, to: 1, text: 'b' }]);
  await settle(server, [page]);
  expect(server.text).toBe('ab');
  expect(page.screen).toBe('ab');
});

test('TwoPagesThatTypeAtRandomEndWithOneText', async () => {
  const edit = fc.record({
    who: fc.integer({ min: 0, max: 1 }),
    at: fc.nat(30),
    remove: fc.nat(4),
    insert: fc.stringMatching(/^[a-z\n]{0,4}$/),
    answers: fc.nat(2),
  });
  await fc.assert(
    fc.asyncProperty(fc.array(edit, { maxLength: 12 }), async (edits) => {
      const server = new Server('line one\nline two\n');
      const pages = [new Page(1, server), new Page(2, server)];
      for (const { who, at, remove, insert, answers } of edits) {
        pages[who]?.type(at, remove, insert);
        await idle();
        for (let count = 0; count < answers; count++) server.waiting.shift()?.();
        await idle();
      }
      await settle(server, pages);
      expect(pages.map((page) => page.screen)).toEqual([server.text, server.text]);
      expect(pages.map((page) => page.shared.text)).toEqual([server.text, server.text]);
    }),
    { numRuns: 60 },
  );
});
