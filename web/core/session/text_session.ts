// The text of one file in this page, with its one history and what the server has not yet taken. All
// views of the file follow it: text editors, the drawing, forms, the world. No wire, no clock.

import { collab, receiveUpdates, sendableUpdates, type Update } from '@codemirror/collab';
import { history, invertedEffects, redo, redoDepth, undo, undoDepth } from '@codemirror/commands';
import {
  Annotation,
  type AnnotationType,
  EditorState,
  Transaction,
  type ChangeSet,
  type ChangeSpec,
  type EditorSelection,
  type StateCommand,
  type StateEffect,
  type Text,
  type TransactionSpec,
} from '@codemirror/state';
import type { JsonStep } from '../../protocol/messages';
import { Emitter } from '../emitter';
import { changeTo, doneAgain, isAsMeant, unstepped, type Again } from './rebase';
import { Anchors, corrects, noted, notesOf, stepped, takenBack, treeIfGood } from './steps';
import { kRowMs, type Row } from './row';

export const kUndoMax = 200;
export interface Followed {
  changes: ChangeSet;
  /** Who made the change, and shows it already; null: all are to show it. */
  from: object | null;
  /** Where undo leads the caret. */
  selection?: EditorSelection | undefined;
}

export interface Typed {
  changes: ChangeSpec;
  /** Milliseconds. */
  at: number;
  from?: object | undefined;
  before?: EditorSelection | undefined;
  after?: EditorSelection | undefined;
  userEvent?: string | undefined;
}

export type Refusal =
  | { why: 'gone'; places: string[] }
  /** What is taken back was changed by somebody else since. */
  | { why: 'undo' };

const kOwn = 'own';
const kOthers = 'others';
const joins = Annotation.define<boolean>();

export class TextSession {
  /** The text is another one. */
  readonly followed = new Emitter<Followed>();
  /** Something that was done here is not, or cannot be. */
  readonly refused = new Emitter<Refusal>();
  private state: EditorState;
  /** What the server has, as far as it has said so. */
  private known: Text;
  /** What the last change was one of; typed: it was text. */
  private last: Row | 'typed' | null = null;
  private readonly anchors = new Anchors();
  /** Steps that were refused once are not tried again with the next change of others. */
  private readonly given = new WeakSet<readonly JsonStep[]>();

  constructor(
    text: string,
    readonly language: string,
  ) {
    this.state = EditorState.create({
      doc: text,
      extensions: [
        history({
          minDepth: kUndoMax,
          newGroupDelay: kRowMs,
          joinToEvent: (one, isAdjacent) => one.annotation(joins) ?? isAdjacent,
        }),
        collab({ clientID: kOwn, sharedEffects: ({ effects }) => effects.filter(isShared) }),
        invertedEffects.of(takenBack),
      ],
    });
    this.known = this.state.doc;
  }

  get doc(): Text {
    return this.state.doc;
  }

  get text(): string {
    return this.doc.toString();
  }

  get confirmed(): Text {
    return this.known;
  }

  /** What the server has not taken yet, in its order. */
  get unsent(): readonly Update[] {
    return sendableUpdates(this.state);
  }

  /** Steps wait for a text that is JSON again. */
  get isHeld(): boolean {
    if (!this.unsent.some(({ effects }) => notesOf(effects).length > 0)) return false;
    return !treeIfGood(this.known.toString()) && !treeIfGood(this.text);
  }

  get canUndo(): boolean {
    return undoDepth(this.state) > 0;
  }

  get canRedo(): boolean {
    return redoDepth(this.state) > 0;
  }

  type({ changes, at, from, before, after, userEvent }: Typed): void {
    if (before) this.apply({ selection: before, annotations: Transaction.addToHistory.of(false) });
    const annotations: Annotation<unknown>[] = [Transaction.time.of(at)];
    if (userEvent) annotations.push(Transaction.userEvent.of(userEvent));
    if (this.last !== 'typed') annotations.push(joins.of(false));
    this.last = 'typed';
    this.tell(this.apply({ changes, selection: after, annotations }).changes, from);
  }

  /** One change of the drawing or a form. Throws if the steps do not fit. */
  step(steps: readonly JsonStep[], at: number, row?: Row): void {
    const { changes, note } = stepped(this.text, this.language, steps);
    if (changes.empty) return;
    const joined = joins.of(goesOn(this.last, row));
    this.last = row ?? null;
    const annotations = [Transaction.time.of(row?.at ?? at), joined];
    this.tell(this.apply({ changes, effects: noted.of(note), annotations }).changes);
  }

  undo(): boolean {
    return this.back(undo);
  }

  redo(): boolean {
    return this.back(redo);
  }

  /** The server has taken the first ones of what was unsent. */
  confirm(count: number): void {
    const own = this.unsent.slice(0, count);
    for (const { changes } of own) this.known = changes.apply(this.known);
    const updates = own.map(({ changes }) => ({ changes, clientID: kOwn }));
    this.state = receiveUpdates(this.state, updates).state;
  }

  /** What others have made of the text that is confirmed. */
  receive(changes: ChangeSet): void {
    this.woven(changes, (one) => this.follow(one));
  }

  /** What the server has made of it because it was asked from here: a step of one's own. */
  receiveOwn(changes: ChangeSet): void {
    this.last = null;
    this.woven(changes, (one) => this.follow(this.remembered(one)));
  }

  private woven(changes: ChangeSet, follow: (one: Transaction) => void): void {
    const base = this.known;
    const before = this.unsent;
    this.known = changes.apply(base);
    const one = receiveUpdates(this.state, [{ changes, clientID: kOthers }]);
    follow(one);
    const again = this.again({ base, changes, before, after: this.unsent });
    const made = again ? one.changes.compose(this.correct(again.text)) : one.changes;
    this.tell(made);
    if (again && again.refused.length > 0)
      this.refused.emit({ why: 'gone', places: again.refused });
  }

  /** The same as a step that undo takes back: collab keeps what it receives out of the history. */
  private remembered(one: Transaction): Transaction {
    // They are not in its types: one of them is collab's own, which it needs.
    const { annotations } = one as unknown as { annotations: readonly Annotation<unknown>[] };
    const others = [Transaction.addToHistory, Transaction.remote, Transaction.time] as const;
    const kept = annotations.filter(
      ({ type }) => !others.some((other) => type === (other as AnnotationType<unknown>)),
    );
    const { changes, effects } = one;
    return this.state.update({
      changes,
      effects,
      annotations: [...kept, joins.of(false)],
      filter: false,
    });
  }

  private again(others: Parameters<typeof doneAgain>[0]): Again | null {
    const steps = others.after.filter(({ effects }) => notesOf(effects).length > 0);
    if (steps.length === 0) return null;
    // Places in the middle of words are looked at only if all that was done are steps.
    const all = steps.length === others.after.length ? [composed(others.after)] : [];
    if (isAsMeant(this.text, all)) return null;
    return doneAgain(others, this.language, this.given);
  }

  private back(command: StateCommand): boolean {
    let made: Transaction | null = null;
    command({ state: this.state, dispatch: (one) => (made = one) });
    const one = made as Transaction | null;
    if (!one) return false;
    this.last = null;
    const wanted = this.wanted(one);
    this.follow(one);
    if (wanted === undefined) this.tell(one.changes, null, one.selection);
    else this.tell(one.changes.compose(this.correct(wanted ?? one.startState.doc.toString())));
    if (wanted === null) this.refused.emit({ why: 'undo' });
    return true;
  }

  /** The text that undo is to lead to, if not to that of its changes; null: it cannot be done. */
  private wanted(one: Transaction): string | null | undefined {
    const notes = notesOf(one.effects);
    const before = this.text;
    if (notes.length === 0 || !treeIfGood(before)) return undefined;
    if (isAsMeant(one.newDoc.toString(), [one.changes])) return undefined;
    return unstepped(before, this.language, notes, this.anchors);
  }

  /** Makes the text that one; not a step of its own. */
  private correct(wanted: string): ChangeSet {
    const changes = changeTo(this.text, wanted);
    if (changes.empty) return changes;
    const annotations = Transaction.addToHistory.of(false);
    return this.apply({ changes, effects: corrects.of(null), annotations }).changes;
  }

  private apply(spec: TransactionSpec): Transaction {
    const one = this.state.update(spec);
    this.follow(one);
    return one;
  }

  private follow(one: Transaction): void {
    this.state = one.state;
    this.anchors.follow(one);
  }

  private tell(changes: ChangeSet, from: object | null = null, selection?: EditorSelection): void {
    this.followed.emit({ changes, from, selection });
  }
}

function isShared(effect: StateEffect<unknown>): boolean {
  return effect.is(noted) || effect.is(corrects);
}

function composed(updates: readonly Update[]): ChangeSet {
  return updates.map(({ changes }) => changes).reduce((all, one) => all.compose(one));
}

function goesOn(last: Row | 'typed' | null, row: Row | undefined): boolean {
  return last !== null && last !== 'typed' && row?.of === last.of && row.at - last.at < kRowMs;
}
