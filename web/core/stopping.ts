// Stop goes two ways at once: as a command, behind what this page has sent already, and as a request
// of its own that nothing is in front of. Whichever arrives first stops the robot; the command is
// sent again on every new connection, the request every second, until one of them was answered.

import type { Commands } from '../protocol/messages';
import type { Connection } from './connection';
import { Emitter } from './emitter';
import type { World } from './socket';

export const kPostAgainMs = 1000;

export type Stopped = Commands['stop']['out'];

export class Stopping {
  readonly changed = new Emitter<void>();
  /** Before anything is sent. */
  readonly pressed = new Emitter<void>();
  /** Stop was pressed, and nobody has answered yet. */
  waits = false;
  private presses = 0;

  constructor(
    private readonly connection: Connection,
    private readonly world: World,
  ) {}

  async press(): Promise<Stopped> {
    const press = ++this.presses;
    this.pressed.emit();
    this.tell(true);
    this.post(press);
    try {
      return await this.connection.send('stop', {});
    } finally {
      this.answered(press);
    }
  }

  private post(press: number): void {
    if (press !== this.presses || !this.waits) return;
    const { link, token } = this.connection;
    const path = link.state === 'open' ? `stop?client=${link.number}` : 'stop';
    this.world.post(path, token).then(
      () => this.answered(press),
      () => void this.world.later(kPostAgainMs, () => this.post(press)),
    );
  }

  private answered(press: number): void {
    if (press === this.presses) this.tell(false);
  }

  private tell(waits: boolean): void {
    if (this.waits === waits) return;
    this.waits = waits;
    this.changed.emit();
  }
}
