// A JSON file that is edited by its members (doc.patch). What is done here shows at once; the server
// is told, one message under way at a time; what others did replaces the value when ours has arrived.

import type { Commands, Json, JsonStep } from '../protocol/messages';
import { CommandError } from './connection';
import type { DocTopic } from './document';
import { Emitter } from './emitter';
import {
  change,
  createHistory,
  redo,
  replace,
  undo,
  type Change,
  type History,
  type Row,
} from './history';
import { asSent } from './json_steps';
import { textDiff } from './text_diff';

export interface JsonLink {
  open(): Promise<Commands['doc.open']['out']>;
  patch(version: number, steps: JsonStep[]): Promise<Commands['doc.patch']['out']>;
  edit(
    version: number,
    changes: Commands['doc.edit']['in']['changes'],
  ): Promise<Commands['doc.edit']['out']>;
}

/** What the server is still to be told: steps, or the text that there was. */
type Order = { steps: JsonStep[]; of: Change | null } | { text: string };

export class JsonDocument {
  readonly changed = new Emitter<void>();
  readonly trouble = new Emitter<string>();
  /** Why the text is no JSON; its value is then the last one that was. */
  broken: string | null = null;

  private readonly history: History;
  private version: number;
  /** The server's text of that version. */
  private text: string;
  private sent: Order | null = null;
  private unsent: Order[] = [];
  private latest: DocTopic | null = null;
  private settled: (() => void)[] = [];

  constructor(
    private readonly link: JsonLink,
    opened: { text: string; version: number },
  ) {
    this.version = opened.version;
    this.text = opened.text;
    this.history = createHistory({});
    this.take(opened.text);
  }

  get value(): Json {
    return this.history.getState().value;
  }

  get canUndo(): boolean {
    return this.history.temporal.getState().pastStates.length > 0;
  }

  get canRedo(): boolean {
    return this.history.temporal.getState().futureStates.length > 0;
  }

  /** One change, taken back by one undo; those of a row are taken back together. */
  commit(steps: JsonStep[], row?: Row): void {
    if (steps.length === 0 || this.broken !== null) return;
    change(this.history, steps, this.coming, row);
    this.tell({ steps, of: this.history.getState().last });
  }

  /** To the text that there was, if nothing came between; else by steps that take it back. */
  undo(): void {
    const { last } = this.history.getState();
    const steps = undo(this.history);
    if (steps) this.tell(this.back(last?.after, last?.before) ?? { steps, of: null });
  }

  redo(): void {
    const steps = redo(this.history);
    const { last } = this.history.getState();
    if (steps) this.tell(this.back(last?.before, last?.after) ?? { steps, of: last });
  }

  private back(from: string | null | undefined, to: string | null | undefined): Order | null {
    return typeof from === 'string' && typeof to === 'string' && this.coming === from
      ? { text: to }
      : null;
  }

  /** The text once all is done that is under way; null: only the server knows. */
  private get coming(): string | null {
    const last = this.unsent.at(-1) ?? this.sent;
    if (last === null) return this.text;
    return 'text' in last ? last.text : null;
  }

  /** What the topic "doc" says; while a change is under way it waits for the answer. */
  told(state: DocTopic): void {
    if (this.sent) this.latest = state;
    else if (state.version !== this.version) this.adopt(state.text, state.version);
  }

  /** Resolves when the server has everything. */
  flushed(): Promise<void> {
    return this.sent ? new Promise((resolve) => this.settled.push(resolve)) : Promise.resolve();
  }

  private tell(order: Order): void {
    const waiting = this.unsent.at(-1);
    if (waiting && 'steps' in waiting && 'steps' in order)
      // Several changes in one message: the text between them is nobody's.
      this.unsent[this.unsent.length - 1] = {
        steps: [...waiting.steps, ...order.steps],
        of: null,
      };
    else this.unsent.push(order);
    this.changed.emit();
    this.flush();
  }

  private flush(): void {
    if (this.sent) return;
    const next = this.unsent.shift();
    if (!next) {
      for (const resolve of this.settled.splice(0)) resolve();
      return;
    }
    this.sent = next;
    this.send(next).then(
      ({ version, text }) => {
        if ('steps' in next && next.of) next.of.after = text;
        this.accepted(version, text);
      },
      (error: unknown) => this.refused(error),
    );
  }

  private async send(order: Order): Promise<{ version: number; text: string }> {
    if ('steps' in order) return this.link.patch(this.version, asSent(order.steps));
    const changes = textDiff(this.text, order.text).map(({ from, to, insert }) => ({
      from,
      to,
      text: insert,
    }));
    if (changes.length === 0) return { version: this.version, text: this.text };
    const { version } = await this.link.edit(this.version, changes);
    return { version, text: order.text };
  }

  private accepted(version: number, text: string): void {
    this.version = version;
    this.text = text;
    this.sent = null;
    const state = this.latest;
    this.latest = null;
    if (state && state.version > version) this.adopt(state.text, state.version);
    else if (this.unsent.length === 0 && !isSame(parsed(text), this.value))
      this.adopt(text, version);
    this.flush();
  }

  /** Someone else was first, or it cannot be done: the server's text counts. */
  private refused(error: unknown): void {
    this.link.open().then(
      ({ text, version }) => {
        this.sent = null;
        this.latest = null;
        this.trouble.emit(whatOf(error));
        this.adopt(text, version);
        this.flush();
      },
      () => {
        this.sent = null;
        this.trouble.emit(whatOf(error));
        this.flush();
      },
    );
  }

  private adopt(text: string, version: number): void {
    this.version = version;
    this.text = text;
    this.unsent = [];
    this.take(text);
    this.changed.emit();
  }

  private take(text: string): void {
    const value = parsed(text);
    this.broken = value === undefined ? whyBroken(text) : null;
    if (value !== undefined && !isSame(value, this.value)) replace(this.history, value);
  }
}

function parsed(text: string): Json | undefined {
  try {
    return JSON.parse(text) as Json;
  } catch {
    return undefined;
  }
}

function whyBroken(text: string): string {
  try {
    JSON.parse(text);
    return '';
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}

function whatOf(error: unknown): string {
  return error instanceof CommandError ? error.problem.what : String(error);
}

/** The order of names does not matter: the server writes those of the format in its own. */
export function isSame(a: Json | undefined, b: Json | undefined): boolean {
  if (a === b) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  if (Array.isArray(a) || Array.isArray(b))
    return (
      Array.isArray(a) &&
      Array.isArray(b) &&
      a.length === b.length &&
      a.every((one, index) => isSame(one, b[index]))
    );
  const names = Object.keys(a);
  return (
    names.length === Object.keys(b).length &&
    names.every((name) => Object.hasOwn(b, name) && isSame(a[name], b[name]))
  );
}
