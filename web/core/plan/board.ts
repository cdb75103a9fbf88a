// One plan on a canvas: its file, what is drawn of it, what is chosen and held. Hands, forms and
// commands change it through here.

import type { Doc, Json, JsonStep } from '../../protocol/messages';
import { Emitter } from '../emitter';
import type { JsonFile } from '../session/json_file';
import { drawingOf, goOn, supervisorKey, type Drawing } from './arrows';
import * as edit from './edit';
import {
  kConfiguration,
  kStart,
  planModel,
  supervisorsOf,
  type Actor,
  type Note,
  type PlanModel,
  type Supervisor,
} from './model';
import { extract, type Extracted, type WhyNot } from './extract';
import * as notes from './notes';
import { Draft, paste, partOf, type Part } from './part';
import {
  dropPlace,
  found,
  freePlace,
  freePlaceIn,
  sceneOf,
  type Places,
  type Scene,
} from './place';
import { kNodeWidth, type Box, type Point } from './shape';
import type { SubPlans } from './sub_plans';
import type { Found, Toolboxes } from './templates';

/** Apart from actors: a variable of that name. */
export const pillKey = (name: string) => `$${name}`;

// For the ways of arrows: while something is dragged, at first, and in each turn after it.
const kWhileHeldMs = 12;
const kAtOnceMs = 80;
const kTurnMs = 20;
/** So often a drawing that is being finished is shown. */
const kShownMs = 1000;
/** Then what has no way yet stays as it is: hundreds of arrows across a large plan would take minutes. */
export const kFinishMsMax = 15_000;

export type Source = Actor | Supervisor | typeof kStart;

/** Where a board gets its time, and goes on with what it does bit by bit. */
export interface Turns {
  /** Milliseconds. */
  now(): number;
  later(act: () => void): void;
}

export class PlanBoard {
  readonly changed = new Emitter<void>();
  /** Said to who cannot see it. */
  readonly spoken = new Emitter<string>();
  /** An arrow is being drawn from there. */
  drawn: { id: string; at: Point } | null = null;
  model: PlanModel;
  scene: Scene;
  drawing: Drawing;
  private chosen = new Set<string>();
  private held = new Map<string, Point>();
  /** Where elements are that have no place in the file. */
  private found: Places = new Map();
  private finishing = false;
  /** There was no time to find a way for every arrow. */
  isCut = false;
  private heldSizes = new Map<string, notes.Size>();

  constructor(
    readonly doc: Doc,
    readonly file: JsonFile,
    private toolboxes: Toolboxes,
    private readonly turns: Turns,
    private subPlans: SubPlans = new Map(),
  ) {
    this.model = planModel(file.value, toolboxes, subPlans);
    this.scene = sceneOf(this.model);
    this.found = found(this.model, this.scene, this.found);
    this.drawing = drawingOf(this.model, this.scene, { isTime: this.within(kAtOnceMs) });
    this.finish();
  }

  /** The file or the templates are others now. */
  refresh(toolboxes: Toolboxes = this.toolboxes, subPlans: SubPlans = this.subPlans): void {
    // Other templates make other boxes, which need another room.
    if (toolboxes !== this.toolboxes) this.found = new Map();
    this.toolboxes = toolboxes;
    this.subPlans = subPlans;
    this.model = planModel(this.file.value, toolboxes, subPlans);
    this.chosen = new Set([...this.chosen].filter((key) => this.has(key)));
    this.redraw();
  }

  // ---- what is chosen ----

  /** Keys of elements, or the id of an arrow. */
  get selection(): ReadonlySet<string> {
    return this.chosen;
  }

  /** What forms are about: what was chosen last. */
  get selected(): string | null {
    return [...this.chosen].at(-1) ?? null;
  }

  select(key: string | null): void {
    this.selectAll(key === null ? [] : [key]);
  }

  selectAll(keys: Iterable<string>): void {
    const wanted = new Set([...keys].filter((key) => this.has(key)));
    if (wanted.size === this.chosen.size && [...wanted].every((key) => this.chosen.has(key)))
      return;
    this.chosen = wanted;
    this.tell();
  }

  /** Also that one, or no longer that one. */
  choose(key: string, also: boolean): void {
    const others = [...this.chosen].filter((one) => one !== key && this.arrow(one) === undefined);
    this.selectAll(also ? [...others, key] : others);
  }

  /** The actors that are chosen. */
  get chosenActors(): ReadonlySet<string> {
    return new Set(this.model.actors.flatMap(({ name }) => (this.chosen.has(name) ? name : [])));
  }

  // ---- what there is ----

  actor(name: string | null): Actor | undefined {
    return this.model.actors.find((one) => one.name === name);
  }

  supervisor(key: string | null): Supervisor | undefined {
    return supervisorsOf(this.model).find((one) => supervisorKey(one) === key);
  }

  element(key: string | null): Actor | Supervisor | undefined {
    return this.actor(key) ?? this.supervisor(key);
  }

  source(key: string): Source | undefined {
    return key === kStart ? kStart : this.element(key);
  }

  variable(key: string | null) {
    return this.model.variables.find((one) => pillKey(one.name) === key);
  }

  note(key: string | null): Note | undefined {
    return this.model.notes.find((one) => notes.noteKey(one.index) === key);
  }

  /** As they are drawn: one that is held is where it is held. */
  get notes(): readonly Note[] {
    return this.model.notes.map((one) => {
      const key = notes.noteKey(one.index);
      const at = this.held.get(key);
      const size = this.heldSizes.get(key);
      return {
        ...one,
        at: at ? [at.x, at.y] : one.at,
        size: size ? [size.width, size.height] : one.size,
      };
    });
  }

  /** The key of what a finding or the live plan calls by its name. */
  keyOf(name: string): string | null {
    if (this.actor(name)) return name;
    const supervisor = supervisorsOf(this.model).find((one) => one.name === name);
    if (supervisor) return supervisorKey(supervisor);
    return this.variable(pillKey(name)) ? pillKey(name) : null;
  }

  arrow(id: string | null) {
    const { arrows, loose } = this.drawing;
    return arrows.find((one) => one.id === id) ?? loose.find((one) => one.id === id);
  }

  /** Where the next arrow of what is selected begins: at a state or event that leads nowhere yet, if there is one. */
  get nextPort(): string | null {
    const { selected } = this;
    if (this.arrow(selected)) return selected;
    const { arrows, loose } = this.drawing;
    return [...loose, ...arrows].find(({ source }) => source === selected)?.id ?? null;
  }

  private has(key: string): boolean {
    return (
      key === kStart ||
      key === kConfiguration ||
      this.element(key) !== undefined ||
      this.variable(key) !== undefined ||
      this.note(key) !== undefined ||
      this.drawing.sides.has(key)
    );
  }

  // ---- moving ----

  /** While they are dragged: shown there, not yet in the file. */
  hold(places: Iterable<readonly [string, Point]>): void {
    for (const [name, at] of places) this.held.set(name, at);
    this.redraw();
  }

  /** The same for the size of a note. */
  holdSize(key: string, size: notes.Size): void {
    this.heldSizes.set(key, notes.fitting(size));
    this.redraw();
  }

  letGo(): void {
    const held = [...this.held];
    const sizes = [...this.heldSizes];
    this.held.clear();
    this.heldSizes.clear();
    this.commit([
      ...held.flatMap(([key, at]) => this.moved(key, at)),
      ...sizes.flatMap(([key, size]) => {
        const note = this.note(key);
        return note ? notes.resizeNote(note, size) : [];
      }),
    ]);
    this.redraw();
  }

  private moved(key: string, at: Point): JsonStep[] {
    const note = this.note(key);
    if (note) return notes.moveNote(note, at);
    return this.isAt(key, at) ? [] : edit.placeSteps(this.file.value, key, at);
  }

  /** Several at new places, as one change. */
  place(places: readonly (readonly [string, Point])[]): void {
    const draft = new Draft(this.file.value);
    for (const [key, at] of places) {
      const note = this.note(key);
      if (note) draft.do(notes.moveNote(note, at));
      else draft.set(['layout', key], [at.x, at.y]);
    }
    this.commit(draft.steps);
  }

  private isAt(name: string, { x, y }: Point): boolean {
    const place = this.model.places.get(name);
    return place !== undefined && place[0] === x && place[1] === y;
  }

  // ---- editing ----

  commit(steps: JsonStep[]): boolean {
    return this.file.commit(steps);
  }

  connect(key: string, outcome: string, target: string | null): void {
    const source = this.source(key);
    if (source) this.commit(edit.connectSteps(this.file.value, source, outcome, target));
  }

  /** room: what is seen of the plan; the actor is put there if it has a place. */
  addActor(found: Found, wanted: Point, room?: Box): string {
    const at = room ? freePlaceIn(room, this.scene, wanted) : freePlace(this.scene, wanted);
    return this.added(edit.addActor(this.file.value, this.model, found, at), (name) => name);
  }

  /** room: what is seen of the plan. */
  dropActor(found: Found, wanted: Point, room: Box): string {
    const at = dropPlace(room, this.scene, wanted);
    return this.added(edit.addActor(this.file.value, this.model, found, at), (name) => name);
  }

  /** Another plan as an actor; `path` counts from the folder of this one. */
  addSubPlan(path: string, wanted: Point, room?: Box): string {
    const at = room ? freePlaceIn(room, this.scene, wanted) : freePlace(this.scene, wanted);
    return this.added(edit.addSubPlan(this.file.value, this.model, path, at), (name) => name);
  }

  /** The chosen actors as a plan of their own, in that file; nothing is changed yet. */
  extract(made: { name: string; path: string }): Extracted | WhyNot {
    const placeOf = (name: string) => this.blockOf(name)?.box ?? { x: 0, y: 0 };
    return extract(this.file.value, this.model, this.chosenActors, { ...made, placeOf });
  }

  /** Attached to an actor, or to @start. */
  addSupervisor(found: Found, owner: string): string {
    const made = edit.addSupervisor(this.file.value, this.model, found, owner);
    return this.added(made, (name) => `${owner}/${name}`);
  }

  /** A new actor to which a state or event leads at once. */
  addTarget(found: Found, wanted: Point, from: { source: string; outcome: string }): string {
    const at = freePlace(this.scene, wanted);
    const source = this.source(from.source);
    const made = edit.addActor(this.file.value, this.model, found, at);
    const draft = new Draft(this.file.value);
    draft.do(made.steps);
    if (source) draft.do(edit.connectSteps(draft.file, source, from.outcome, made.name));
    return this.added({ name: made.name, steps: draft.steps }, (name) => name);
  }

  addVariable(): string {
    return this.added(edit.addVariable(this.file.value, this.model), pillKey);
  }

  /** An empty one, to be written at once; null: the file keeps something else in their place. */
  addNote(near: Point): string | null {
    const at = freePlace(this.scene, near, notes.kNoteSize);
    const made = notes.addNote(this.file.value, at);
    if (!made) return null;
    this.commit(made.steps);
    this.select(made.key);
    return made.key;
  }

  /** What is chosen, as it can be pasted; null: nothing that can. */
  part(): Part | null {
    const supervisors = supervisorsOf(this.model).filter((one) =>
      this.chosen.has(supervisorKey(one)),
    );
    return partOf(
      this.file.value,
      this.model,
      { actors: this.chosenActors, supervisors },
      (name) => this.blockOf(name)?.box ?? { x: 0, y: 0 },
    );
  }

  /** Puts a part where nothing is covered, near a point, and chooses it. */
  paste(part: Part, near: Point): void {
    const size = sizeOf(part);
    const { selected } = this;
    const owner = this.actor(selected)?.name ?? this.supervisor(selected)?.owner ?? kStart;
    const made = paste(this.file.value, this.model, part, {
      at: freePlace(this.scene, near, size),
      owner,
    });
    this.commit(made.steps);
    this.selectAll([...made.actors, ...made.supervisors.map((name) => `${owner}/${name}`)]);
  }

  duplicate(): void {
    const part = this.part();
    const [first] = part?.layout.values() ?? [];
    if (part) this.paste(part, { x: (first?.x ?? 0) + 24, y: (first?.y ?? 0) + 24 });
  }

  /** Where an element is. */
  boxOf(key: string): Box | undefined {
    const { start, actors, pills } = this.scene;
    if (key === kStart) return start.box;
    const supervisor = this.supervisor(key);
    const hanging = [start, ...actors].find((one) => one.name === supervisor?.owner)?.supervisors;
    return (
      this.blockOf(key)?.box ??
      hanging?.find((one) => one.supervisor.name === supervisor?.name)?.box ??
      pills.find((one) => pillKey(one.name) === key)?.box
    );
  }

  private blockOf(name: string) {
    return this.scene.actors.find((one) => one.name === name);
  }

  private added(made: edit.Added, keyOf: (name: string) => string): string {
    const key = keyOf(made.name);
    this.commit(made.steps);
    this.select(key);
    return key;
  }

  /** Removes what is chosen, as one change; gives the key of what is near it. */
  removeChosen(): string {
    const { selected } = this;
    const near = this.supervisor(selected)?.owner ?? this.arrow(selected)?.source ?? kStart;
    const draft = new Draft(this.file.value);
    for (const key of notes.inRemovalOrder(this.chosen)) draft.do(this.removal(draft.file, key));
    this.commit(draft.steps);
    return this.actor(near) ? near : kStart;
  }

  /** Of an element, a variable, or where an arrow leads. */
  private removal(file: Json, key: string): JsonStep[] {
    const keys = this.supervisor(key)?.keys ?? this.variableKeys(key);
    const arrow = this.arrow(key);
    const note = this.note(key);
    if (note) return notes.removeNote(file, note.index);
    if (this.actor(key)) return edit.removeActor(file, planModel(file, this.toolboxes), key);
    if (keys) return edit.dropSteps(file, keys);
    const source = arrow && this.source(arrow.source);
    return source ? edit.connectSteps(file, source, arrow.outcome, null) : [];
  }

  private variableKeys(key: string): string[] | undefined {
    const variable = this.variable(key);
    return variable && ['configuration', variable.name];
  }

  /** False: not now. */
  rename(key: string, to: string): boolean {
    const { value, broken } = this.file;
    if (broken !== null) return false;
    const place = this.found.get(key);
    if (place) this.found = new Map([...this.found, [to, place]]);
    const supervisor = this.supervisor(key);
    const variable = this.variable(key);
    const steps = this.actor(key)
      ? edit.renameActor(value, this.model, key, to)
      : supervisor
        ? edit.renamedKey(value, supervisor.keys.slice(0, -1), supervisor.name, to)
        : variable
          ? edit.renameVariable(value, this.model, variable.name, to)
          : [];
    const next = supervisor ? `${supervisor.owner}/${to}` : variable ? pillKey(to) : to;
    this.commit(steps);
    this.select(next);
    return true;
  }

  /** The value in the file. */
  at(keys: readonly string[]): Json | undefined {
    return edit.valueAt(this.file.value, keys);
  }

  draw(drawn: { id: string; at: Point } | null): void {
    this.drawn = drawn;
    this.tell();
  }

  private redraw(): void {
    const places = new Map(this.model.places);
    for (const [name, { x, y }] of this.held) places.set(name, [x, y]);
    const isHeld = this.held.size + this.heldSizes.size > 0;
    const model = isHeld ? { ...this.model, places, notes: this.notes } : this.model;
    this.scene = sceneOf(model, this.found);
    this.found = found(model, this.scene, this.found);
    this.drawing = drawingOf(model, this.scene, {
      isTime: this.within(isHeld ? kWhileHeldMs : kAtOnceMs),
      before: this.drawing,
      // What took so long is not looked for again at each step.
      keeps: isHeld || this.isCut,
    });
    this.isCut = false;
    this.tell();
    this.finish();
  }

  /** Finds the ways that are only sketched, bit by bit: the page stays quick meanwhile. */
  private finish(): void {
    if (this.finishing || !this.drawing.isSketch) return;
    this.finishing = true;
    let shown = this.turns.now();
    let worked = 0;
    const turn = () => {
      const begun = this.turns.now();
      this.finishing = false;
      this.drawing = goOn(this.drawing, { isTime: this.within(kTurnMs) });
      worked += this.turns.now() - begun;
      this.isCut = this.drawing.isSketch && worked >= kFinishMsMax;
      if (!this.drawing.isSketch || this.isCut || this.turns.now() - shown > kShownMs) {
        shown = this.turns.now();
        this.tell();
      }
      if (!this.drawing.isSketch || this.isCut) return;
      this.finishing = true;
      this.turns.later(turn);
    };
    this.turns.later(turn);
  }

  private within(ms: number): () => boolean {
    const end = this.turns.now() + ms;
    return () => this.turns.now() >= end;
  }

  private tell(): void {
    this.changed.emit();
  }
}

/** About what a part covers: its actors are not yet laid out. */
function sizeOf(part: Part): { width: number; height: number } {
  const places = [...part.layout.values()];
  if (places.length === 0) return { width: 0, height: 0 };
  const spread = (values: number[]) => Math.max(...values) - Math.min(...values);
  return {
    width: spread(places.map(({ x }) => x)) + kNodeWidth,
    height: spread(places.map(({ y }) => y)) + 2 * kRowOfBlocks,
  };
}

/** An actor with two states and two supervisors, about. */
const kRowOfBlocks = 92;
