// A JSON file that is edited by its members (doc.patch). What is done here shows at once; the server
// is told, one message under way at a time; what others did replaces the value when ours has arrived.

import type { Commands, Json, JsonStep } from '../protocol/messages';
import { CommandError } from './connection';
import type { DocTopic } from './document';
import { Emitter } from './emitter';
import { change, createHistory, redo, replace, undo, type History, type Row } from './history';

export interface JsonLink {
  open(): Promise<Commands['doc.open']['out']>;
  patch(version: number, steps: JsonStep[]): Promise<Commands['doc.patch']['out']>;
}

export class JsonDocument {
  readonly changed = new Emitter<void>();
  readonly trouble = new Emitter<string>();
  /** Why the text is no JSON; its value is then the last one that was. */
  broken: string | null = null;

  private readonly history: History;
  private version: number;
  private sent: JsonStep[] | null = null;
  private unsent: JsonStep[] = [];
  private latest: DocTopic | null = null;
  private settled: (() => void)[] = [];

  constructor(
    private readonly link: JsonLink,
    opened: { text: string; version: number },
  ) {
    this.version = opened.version;
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
    this.tell(change(this.history, steps, row));
  }

  undo(): void {
    this.tell(undo(this.history) ?? []);
  }

  redo(): void {
    this.tell(redo(this.history) ?? []);
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

  private tell(steps: JsonStep[]): void {
    if (steps.length === 0) return;
    this.unsent.push(...steps);
    this.changed.emit();
    this.flush();
  }

  private flush(): void {
    if (this.sent) return;
    if (this.unsent.length === 0) {
      for (const resolve of this.settled.splice(0)) resolve();
      return;
    }
    this.sent = this.unsent;
    this.unsent = [];
    this.link.patch(this.version, this.sent).then(
      ({ version, text }) => this.accepted(version, text),
      (error: unknown) => this.refused(error),
    );
  }

  private accepted(version: number, text: string): void {
    this.version = version;
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
