// A session's text as the value of a JSON file: what drawings, forms and worlds show and change.

import type { Json, JsonStep } from '../../protocol/messages';
import { Emitter } from '../emitter';
import type { Row } from './row';
import type { TextSession } from './text_session';
import { whyOf } from '../why';

export class JsonFile {
  readonly changed = new Emitter<void>();
  /** Why the text is no JSON; the value is then the last one that was, and nothing is changed. */
  broken: string | null = null;
  value: Json = {};
  /** It was JSON at some time. */
  isKnown = false;
  private readonly end: () => void;

  constructor(
    readonly session: TextSession,
    private readonly now: () => number,
  ) {
    this.read();
    this.end = session.followed.on(({ changes }) => {
      if (changes.empty) return;
      this.read();
      this.changed.emit();
    });
  }

  close(): void {
    this.end();
  }

  get canUndo(): boolean {
    return this.session.canUndo;
  }

  get canRedo(): boolean {
    return this.session.canRedo;
  }

  /** One change, taken back by one undo; those of a row are taken back together. False: not now. */
  commit(steps: readonly JsonStep[], row?: Row): boolean {
    if (this.broken !== null) return false;
    if (steps.length > 0) this.session.step(steps, this.now(), row);
    return true;
  }

  undo(): void {
    this.session.undo();
  }

  redo(): void {
    this.session.redo();
  }

  private read(): void {
    try {
      this.value = JSON.parse(this.session.text) as Json;
      this.broken = null;
      this.isKnown = true;
    } catch (error) {
      this.broken = whyOf(error);
    }
  }
}
