// What this page did by hand in the world of a run: undone and done again by orders like those that
// did it, and what is left of it as changes, which the file of the world can keep (keep.ts).

import type { CommandName, Commands, SceneObject } from '../../protocol/messages';
import { Emitter } from '../emitter';
import { kRowMs, type Row } from '../session/row';
import type { Pose } from './geometry';
import { tidy } from './snap';

/** Deeds that can be undone; the oldest are forgotten as undo, their changes stay. */
export const kDeedsMax = 200;

/** An object as it was when a hand touched it, with all that is needed to put it back. */
export interface HandObject extends Omit<SceneObject, 'number'> {
  pose: Pose;
}

export type Deed =
  | { is: 'robot'; name: string; from: Pose; to: Pose }
  | { is: 'move'; number: number; object: HandObject; to: Pose }
  | { is: 'put'; number: number; object: HandObject }
  | { is: 'take'; number: number; object: HandObject }
  | { is: 'light'; number: number; object: HandObject; on: boolean };

/** What all deeds at one thing come to. */
export interface Change {
  key: string;
  /** Its name, if it is a robot. */
  robot: string | null;
  /** As it was at first; null of a robot. */
  object: HandObject | null;
  /** Its number in the world it was changed in: 1 is the first object of the file. */
  number: number;
  put: boolean;
  taken: boolean;
  from: Pose;
  to: Pose;
  /** A lamp that was switched. */
  on: boolean | null;
  /** How the file has it since it was kept. */
  kept: Kept | null;
}

export interface Kept {
  id: string;
  pose: Pose;
}

/** What a reload of the page finds again. */
interface Stored {
  opening: string;
  done: Deed[];
  undone: Deed[];
  before: readonly Change[];
  kept: [string, Kept][];
  keptText: string | null;
}

type Send = <C extends CommandName>(
  command: C,
  input: Commands[C]['in'],
) => Promise<Commands[C]['out']>;

export class Hand {
  /** What can be undone, or what is changed. */
  readonly changed = new Emitter<void>();
  readonly failed = new Emitter<unknown>();
  /** A text of the file that says no more than the run shows. */
  keptText: string | null = null;
  private done: Deed[] = [];
  private undone: Deed[] = [];
  /** Of worlds that were opened before, and of deeds that are forgotten. */
  private before: readonly Change[] = [];
  private readonly kept = new Map<string, Kept>();
  private row: Row | null = null;
  private opening: string | null = null;
  private stored: Stored | null = null;
  private work: Promise<void> = Promise.resolve();

  constructor(private readonly send: Send) {}

  get canUndo(): boolean {
    return this.done.length > 0;
  }

  get canRedo(): boolean {
    return this.undone.length > 0;
  }

  /** All changes are of the world that is there now. */
  get isOfThisRun(): boolean {
    return this.before.length === 0;
  }

  /** It has been done. Deeds of a row are undone together. */
  note(deed: Deed, row: Row | null = null): void {
    const last = this.done.at(-1);
    const goes = row !== null && this.row?.of === row.of && row.at - this.row.at < kRowMs;
    this.row = row;
    this.undone = [];
    const both = goes && last ? joined(last, deed) : null;
    if (both) this.done.pop();
    this.done.push(both ?? deed);
    if (this.done.length > kDeedsMax) {
      this.before = changesOf(this.done.splice(0, 1), this.before, this.kept);
    }
    this.changed.emit();
  }

  undo(): Promise<void> {
    return this.one('undo', (deed) => this.takeBack(deed));
  }

  redo(): Promise<void> {
    return this.one('redo', (deed) => this.again(deed));
  }

  /** What is left of all deeds, one for each thing. */
  changes(): readonly Change[] {
    return changesOf(this.done, this.before, this.kept);
  }

  /** The file has these now; `text`: it is the world of the run with what was done there. */
  keep(kept: ReadonlyMap<string, Kept>, text: string | null): void {
    this.keptText = text ?? this.keptText;
    for (const [key, one] of kept) this.kept.set(key, one);
    this.before = this.before.map((one) => ({ ...one, kept: kept.get(one.key) ?? one.kept }));
    this.changed.emit();
  }

  /** A word for the world that is there: in another one nothing can be undone. */
  opened(opening: string): void {
    if (opening === this.opening) return;
    const first = this.opening === null;
    const old = this.opening;
    this.opening = opening;
    if (first) return this.takeStored();
    this.before = this.changes().map((one) =>
      one.robot !== null || one.key.startsWith('before:')
        ? one
        : { ...one, key: `before:${old}:${one.key}` },
    );
    this.kept.clear();
    this.keptText = null;
    this.forgetDeeds();
  }

  /** For restore(), after a reload. */
  text(): string {
    if (this.opening === null) return this.stored === null ? '' : JSON.stringify(this.stored);
    const { opening, done, undone, before, keptText } = this;
    const stored: Stored = { opening, done, undone, before, kept: [...this.kept], keptText };
    return JSON.stringify(stored);
  }

  /** What text() gave counts if the world is then still the one it is about. */
  restore(text: string | null): void {
    this.stored = text ? (JSON.parse(text) as Stored) : null;
  }

  private takeStored(): void {
    const { stored, opening } = this;
    this.stored = null;
    if (stored?.opening !== opening) return;
    this.done = [...stored.done, ...this.done];
    this.undone = stored.undone;
    this.before = stored.before;
    for (const [key, one] of stored.kept) this.kept.set(key, one);
    this.keptText = stored.keptText;
    this.changed.emit();
  }

  /** Nobody wants to keep it. */
  forget(): void {
    this.before = [];
    this.kept.clear();
    this.forgetDeeds();
  }

  private forgetDeeds(): void {
    this.done = [];
    this.undone = [];
    this.row = null;
    this.changed.emit();
  }

  /** One after the other: an answer may bring the number that the next one needs. */
  private one(what: 'undo' | 'redo', act: (deed: Deed) => Promise<void>): Promise<void> {
    this.work = this.work.then(async () => {
      const { opening } = this;
      const deed = (what === 'undo' ? this.done : this.undone).pop();
      if (!deed) return;
      this.row = null;
      try {
        await act(deed);
        // Not in another world that was opened meanwhile.
        if (opening === this.opening) (what === 'undo' ? this.undone : this.done).push(deed);
      } catch (problem) {
        this.failed.emit(problem);
      }
      this.changed.emit();
    });
    return this.work;
  }

  private async takeBack(deed: Deed): Promise<void> {
    switch (deed.is) {
      case 'robot':
        return void (await this.send('world.move', { robot: deed.name, ...at(deed.from) }));
      case 'move':
        return void (await this.send('world.move', {
          object: deed.number,
          ...at(deed.object.pose),
        }));
      case 'put':
        return void (await this.send('world.take', { object: deed.number }));
      case 'take':
        return this.put(deed);
      case 'light':
        return void (await this.send('world.light', { object: deed.number, on: !deed.on }));
    }
  }

  private async again(deed: Deed): Promise<void> {
    switch (deed.is) {
      case 'robot':
        return void (await this.send('world.move', { robot: deed.name, ...at(deed.to) }));
      case 'move':
        return void (await this.send('world.move', { object: deed.number, ...at(deed.to) }));
      case 'put':
        return this.put(deed);
      case 'take':
        return void (await this.send('world.take', { object: deed.number }));
      case 'light':
        return void (await this.send('world.light', { object: deed.number, on: deed.on }));
    }
  }

  /** It gets a new number, by which all deeds know it from then on. */
  private async put(deed: { number: number; object: HandObject }): Promise<void> {
    const old = deed.number;
    const { number } = await this.send('world.put', putting(deed.object));
    for (const one of [...this.done, ...this.undone, deed])
      if ('number' in one && one.number === old) one.number = number;
    const kept = this.kept.get(keyOf(old));
    if (kept) this.kept.set(keyOf(number), kept);
    this.kept.delete(keyOf(old));
  }
}

export function putting({ id, pose, ...object }: HandObject): Commands['world.put']['in'] {
  return { ...object, ...at(pose), ...(id === '' ? {} : { id }) };
}

function at({ x, y, angle }: Pose): { at: [number, number]; angle: number } {
  return { at: [tidy(x), tidy(y)], angle: tidy(angle) };
}

function keyOf(number: number): string {
  return `object:${number}`;
}

/** Two moves of one thing are one; null: they are not. */
function joined(last: Deed, next: Deed): Deed | null {
  if (last.is === 'robot' && next.is === 'robot' && last.name === next.name)
    return { ...last, to: next.to };
  if (last.is === 'move' && next.is === 'move' && last.number === next.number)
    return { ...last, to: next.to };
  return null;
}

function changesOf(
  deeds: readonly Deed[],
  before: readonly Change[],
  kept: ReadonlyMap<string, Kept>,
): readonly Change[] {
  const all = new Map<string, Change>(before.map((one) => [one.key, { ...one }]));
  for (const deed of deeds) {
    const change = begun(all, deed, kept);
    switch (deed.is) {
      case 'robot':
      case 'move':
        change.to = deed.to;
        break;
      case 'put':
        change.put = true;
        break;
      case 'take':
        change.taken = true;
        break;
      case 'light':
        change.on = deed.on === change.object?.on ? null : deed.on;
        break;
    }
  }
  return [...all.values()].filter(isChange);
}

function begun(all: Map<string, Change>, deed: Deed, kept: ReadonlyMap<string, Kept>): Change {
  const robot = deed.is === 'robot' ? deed.name : null;
  const number = deed.is === 'robot' ? 0 : deed.number;
  const key = robot === null ? keyOf(number) : `robot:${robot}`;
  const known = all.get(key);
  if (known) return known;
  const object = deed.is === 'robot' ? null : deed.object;
  const from = deed.is === 'robot' ? deed.from : deed.object.pose;
  const made: Change = {
    key,
    robot,
    object,
    number,
    put: false,
    taken: false,
    from,
    to: from,
    on: null,
    kept: kept.get(key) ?? null,
  };
  all.set(key, made);
  return made;
}

/** What was put and taken again is none, unless the file has it. */
function isChange({ put, taken, from, to, on, kept }: Change): boolean {
  if (put || taken) return put !== taken || kept !== null;
  const moved = Math.hypot(to.x - from.x, to.y - from.y) > 0 || to.angle !== from.angle;
  return moved || on !== null || kept !== null;
}
