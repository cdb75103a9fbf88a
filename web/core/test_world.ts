// A world for tests: sockets that the test answers, time that it moves, no chance.

import type { Socket, SocketEvents, World } from './socket';

export interface TestSocket {
  sent: { id: number; do: string; in: Record<string, unknown> }[];
  events: SocketEvents;
  closed: boolean;
}

export interface TestPost {
  path: string;
  token: string;
  delivered: () => void;
  lost: () => void;
}

export class TestWorld implements World {
  readonly sockets: TestSocket[] = [];
  readonly posts: TestPost[] = [];
  private now = 0;
  private due: { at: number; act: () => void }[] = [];

  connect(events: SocketEvents): Socket {
    const socket: TestSocket = { sent: [], events, closed: false };
    this.sockets.push(socket);
    return {
      send: (text) => socket.sent.push(JSON.parse(text) as TestSocket['sent'][number]),
      close: () => void (socket.closed = true),
    };
  }

  later(milliseconds: number, act: () => void): () => void {
    const entry = { at: this.now + milliseconds, act };
    this.due.push(entry);
    return () => void (this.due = this.due.filter((one) => one !== entry));
  }

  frame(act: () => void): void {
    this.later(16, act);
  }

  chance(): number {
    return 0.5;
  }

  post(path: string, token: string): Promise<void> {
    return new Promise((delivered, lost) =>
      this.posts.push({ path, token, delivered, lost: () => lost(new Error('not delivered')) }),
    );
  }

  pass(milliseconds: number): void {
    const until = this.now + milliseconds;
    for (;;) {
      const next = this.due.filter((one) => one.at <= until).sort((a, b) => a.at - b.at)[0];
      if (!next) break;
      this.due = this.due.filter((one) => one !== next);
      this.now = next.at;
      next.act();
    }
    this.now = until;
  }

  get last(): TestSocket {
    const socket = this.sockets.at(-1);
    if (!socket) throw new Error('no socket yet');
    return socket;
  }

  /** Opens the newest socket and answers its hello. */
  welcome(number = 7, more: Record<string, unknown> = {}): void {
    this.last.events.open();
    const hello = this.last.sent[0];
    this.say({
      id: hello?.id,
      ok: {
        version: 'test',
        epoch: 'e',
        client: 'me',
        role: 'drive',
        number,
        driver: true,
        now: 0,
        wall: 0,
        ...more,
      },
    });
  }

  say(message: unknown): void {
    this.last.events.text(JSON.stringify(message));
  }
}
