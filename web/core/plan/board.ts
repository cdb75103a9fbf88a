// One plan on a canvas: its file, what is drawn of it, what is chosen and held. Hands, forms and
// commands change it through here.

import type { Doc, Json, JsonStep } from '../../protocol/messages';
import { Emitter } from '../emitter';
import type { JsonDocument } from '../json_document';
import { drawingOf, supervisorKey, type Drawing } from './arrows';
import * as edit from './edit';
import {
  kConfiguration,
  kStart,
  planModel,
  supervisorsOf,
  type Actor,
  type PlanModel,
  type Supervisor,
} from './model';
import { freePlace, sceneOf, type Scene } from './place';
import type { Point } from './shape';
import type { Found, Toolboxes } from './templates';

/** Apart from actors: a variable of that name. */
export const pillKey = (name: string) => `$${name}`;

export type Source = Actor | Supervisor | typeof kStart;

export class PlanBoard {
  readonly changed = new Emitter<void>();
  /** Said to who cannot see it. */
  readonly spoken = new Emitter<string>();
  /** Key of an element, or id of an arrow. */
  selected: string | null = null;
  /** An arrow is being drawn from there. */
  drawn: { id: string; at: Point } | null = null;
  model: PlanModel;
  scene: Scene;
  drawing: Drawing;
  private held = new Map<string, Point>();

  constructor(
    readonly doc: Doc,
    readonly file: JsonDocument,
    private toolboxes: Toolboxes,
  ) {
    this.model = planModel(file.value, toolboxes);
    this.scene = sceneOf(this.model);
    this.drawing = drawingOf(this.model, this.scene);
  }

  /** The file or the templates are others now. */
  refresh(toolboxes: Toolboxes = this.toolboxes): void {
    this.toolboxes = toolboxes;
    this.model = planModel(this.file.value, toolboxes);
    if (this.selected !== null && !this.has(this.selected)) this.selected = null;
    this.redraw();
  }

  select(key: string | null): void {
    if (key === this.selected) return;
    this.selected = key;
    this.tell();
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

  private has(key: string): boolean {
    return (
      key === kStart ||
      key === kConfiguration ||
      this.element(key) !== undefined ||
      this.variable(key) !== undefined ||
      this.drawing.sides.has(key)
    );
  }

  // ---- moving ----

  /** While it is dragged: shown there, not yet in the file. */
  hold(name: string, at: Point): void {
    this.held.set(name, at);
    this.redraw();
  }

  letGo(): void {
    const held = [...this.held];
    this.held.clear();
    const moved = held.filter(([name, at]) => !this.stands(name, at));
    this.commit(moved.flatMap(([name, at]) => edit.placeSteps(this.file.value, name, at)));
    this.redraw();
  }

  private stands(name: string, { x, y }: Point): boolean {
    const place = this.model.places.get(name);
    return place !== undefined && place[0] === x && place[1] === y;
  }

  // ---- editing ----

  commit(steps: JsonStep[]): void {
    this.file.commit(steps);
  }

  connect(key: string, outcome: string, target: string | null): void {
    const source = this.source(key);
    if (source) this.commit(edit.connectSteps(this.file.value, source, outcome, target));
  }

  addActor(found: Found, wanted: Point): string {
    const at = freePlace(this.scene, wanted);
    return this.added(edit.addActor(this.file.value, this.model, found, at), (name) => name);
  }

  /** Attached to an actor, or to @start. */
  addSupervisor(found: Found, owner: string): string {
    const made = edit.addSupervisor(this.file.value, this.model, found, owner);
    return this.added(made, (name) => `${owner}/${name}`);
  }

  addVariable(): string {
    return this.added(edit.addVariable(this.file.value, this.model), pillKey);
  }

  duplicate(name: string): string | null {
    const block = this.scene.actors.find((one) => one.name === name);
    if (!block) return null;
    const at = freePlace(this.scene, { x: block.box.x + 24, y: block.box.y + 24 });
    return this.added(edit.duplicate(this.file.value, this.model, name, at), (one) => one);
  }

  private added(made: edit.Added, keyOf: (name: string) => string): string {
    const key = keyOf(made.name);
    this.commit(made.steps);
    this.select(key);
    return key;
  }

  /** Removes an element, a variable, or where an arrow leads; gives the key of what is near it. */
  remove(key: string): string {
    const { value } = this.file;
    const arrow = this.arrow(key);
    const supervisor = this.supervisor(key);
    const variable = this.variable(key);
    if (this.actor(key)) this.commit(edit.removeActor(value, this.model, key));
    else if (supervisor) this.commit(edit.dropSteps(value, supervisor.keys));
    else if (variable) this.commit(edit.dropSteps(value, ['configuration', variable.name]));
    else if (arrow) this.connect(arrow.source, arrow.outcome, null);
    return supervisor?.owner ?? arrow?.source ?? kStart;
  }

  rename(key: string, to: string): void {
    const { value } = this.file;
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
    const model = this.held.size > 0 ? { ...this.model, places } : this.model;
    this.scene = sceneOf(model);
    this.drawing = drawingOf(model, this.scene);
    this.tell();
  }

  private tell(): void {
    this.changed.emit();
  }
}
