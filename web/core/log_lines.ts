// Which lines of scripts have log points: all that an editor needs of them, for its gutter. What they
// ask and find is loaded with the first of them (logs.ts).

import type { Doc } from '../protocol/messages';
import { deskFor } from './desk';
import { Emitter } from './emitter';

export interface LogLine {
  doc: Doc;
  line: number;
  /** '': they are still to be typed. */
  values: string;
}

export class LogLines {
  readonly changed = new Emitter<void>();
  all: readonly LogLine[] = [];

  show(lines: readonly LogLine[]): void {
    if (JSON.stringify(lines) === JSON.stringify(this.all)) return;
    this.all = lines;
    this.changed.emit();
  }
}

export const logLinesOf = deskFor((_owner: object) => new LogLines());
