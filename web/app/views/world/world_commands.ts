// What can be done in the world that is looked at. Keys count while the focus is in its picture.

import type { Command } from '../../../core/registry';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { radians, type Pose } from '../../../core/world/geometry';
import { copySteps } from '../../../core/world/file';
import type { Placing, WorldModel } from '../../../core/world/model';
import { snapAngle, tidy } from '../../../core/world/snap';
import { objectKinds, robotTypes } from '../../../core/world/stage';
import { panned, zoomed } from '../../../core/world/view';
import { text } from '../../text';
import { deskOf, type ShownWorld } from './desk';
import { keepInWorld, redoInRun, undoInRun } from './keep_acts';
import { optionsOf, toggleOption } from './options';
import { putDown } from './use_hands';
import { spokenPlace, worldNeeds as words } from './words';
import { askWhy } from '../../commands/ask_why';
import { projectOf } from '../../commands/looks';

const titles = text.commands;
const group = text.groups.world;
const within = 'world';
const kStep = 0.01;
const kFar = 0.1;
const kTurn = radians(5);
const kPanPx = 40;

type WorldId = Extract<keyof typeof titles, `world.${string}`>;

export function worldCommands(studio: Studio): Command[] {
  const shown = () => deskOf(studio).shown;
  const make = (
    id: WorldId,
    keys: string[],
    run: (world: ShownWorld) => void,
    {
      needs,
      ...more
    }: { may?: (world: ShownWorld) => boolean; hidden?: boolean; needs?: Need } = {},
  ): Command => ({
    id,
    title: titles[id],
    group,
    within,
    ...(keys.length > 0 ? { keys } : {}),
    ...(more.hidden ? { hidden: true } : {}),
    ...(needs ? { why: () => whyNotIn(studio, shown(), needs) } : {}),
    enabled() {
      const world = shown();
      return world !== undefined && (more.may?.(world) ?? true);
    },
    run() {
      const world = shown();
      if (world) run(world);
    },
  });
  const arrow = (id: WorldId, key: string, x: number, y: number, far: boolean) =>
    make(id, [key], ({ model }) => nudge(model, x, y, far), { hidden: true });
  const has = ({ model }: ShownWorld) => model.chosen !== undefined && (model.acts?.may ?? false);
  const turns = (world: ShownWorld) => has(world) || world.model.placing !== null;
  const touches = ({ file, model }: ShownWorld) => file === null && (model.acts?.may ?? false);
  const edits = ({ file, model }: ShownWorld) => file !== null && (model.acts?.may ?? false);
  return [
    make('world.next', ['N'], ({ model }) => choose(model, 1)),
    make('world.previous', ['Shift+N'], ({ model }) => choose(model, -1)),
    arrow('world.left', 'ArrowLeft', -1, 0, false),
    arrow('world.right', 'ArrowRight', 1, 0, false),
    arrow('world.up', 'ArrowUp', 0, 1, false),
    arrow('world.down', 'ArrowDown', 0, -1, false),
    arrow('world.farLeft', 'Shift+ArrowLeft', -1, 0, true),
    arrow('world.farRight', 'Shift+ArrowRight', 1, 0, true),
    arrow('world.farUp', 'Shift+ArrowUp', 0, 1, true),
    arrow('world.farDown', 'Shift+ArrowDown', 0, -1, true),
    // Brackets are typed with AltGr on many keyboards, which no command is on.
    make('world.turnLeft', ['Ctrl+ArrowLeft', '['], ({ model }) => turn(model, kTurn), {
      may: turns,
      needs: 'thing',
    }),
    make('world.turnRight', ['Ctrl+ArrowRight', ']'], ({ model }) => turn(model, -kTurn), {
      may: turns,
      needs: 'thing',
    }),
    make('world.put', ['Enter'], ({ model }) => putDown(model), {
      may: ({ model }) => model.placing !== null,
      hidden: true,
    }),
    make('world.cancel', ['Escape'], ({ model }) => giveUp(model), {
      may: ({ model }) => model.placing !== null || model.selected !== null,
      hidden: true,
    }),
    make(
      'world.take',
      ['Delete', 'Backspace'],
      ({ model }) => model.chosen && model.acts?.take(model.chosen),
      { may: (world) => has(world) && (world.file !== null || !isRobot(world)), needs: 'thing' },
    ),
    make('world.copy', ['Ctrl+D'], copy, {
      may: (world) => edits(world) && has(world),
      needs: 'thingOfFile',
    }),
    make('world.undo', ['Ctrl+Z'], ({ file }) => (file ? file.undo() : undoInRun(studio)), {
      may: (world) => (edits(world) ? (world.file?.canUndo ?? false) : touches(world)),
    }),
    make(
      'world.redo',
      ['Ctrl+Y', 'Ctrl+Shift+Z'],
      ({ file }) => (file ? file.redo() : redoInRun(studio)),
      { may: (world) => (edits(world) ? (world.file?.canRedo ?? false) : touches(world)) },
    ),
    {
      id: 'world.keep',
      title: titles['world.keep'],
      group,
      enabled: () => studio.drives && studio.hand.changes().length > 0,
      run: () => keepInWorld(studio),
    },
    make('world.fit', ['1'], ({ model }) => model.fit()),
    make('world.zoomIn', ['+', '='], ({ model }) => zoom(model, 1.25)),
    make('world.zoomOut', ['-'], ({ model }) => zoom(model, 0.8)),
    make(
      'world.follow',
      ['F'],
      ({ model }) => model.follow(model.follows === model.selected ? null : model.selected),
      { may: isRobot },
    ),
    make('world.why', ['W'], ({ model }) => void askWhy(studio, 'motor', askedOf(model)), {
      may: ({ file, model }) => file === null && askedOf(model) !== undefined,
    }),
    make('world.solid', ['3'], () => toggleOption(studio, 'solid')),
    make('world.rays', ['R'], () => toggleOption(studio, 'rays')),
    make('world.trails', ['T'], () => toggleOption(studio, 'trails')),
    make('world.clearTrails', [], ({ model }) => {
      if (model.trails === studio.ways.trails) studio.ways.clear();
      else model.trails.clear();
      model.drawn.emit();
    }),
    make('world.grid', ['G'], () => toggleOption(studio, 'grid')),
    make('world.picture', ['P'], () => toggleOption(studio, 'picture')),
    make('world.list', ['L'], () => toggleOption(studio, 'list')),
    make('world.snap', ['S'], () => toggleOption(studio, 'snap'), { may: edits, needs: 'file' }),
    {
      id: 'world.open',
      title: titles['world.open'],
      group,
      enabled: () => projectOf(studio)?.world !== undefined,
      run: () => revealDoc(studio.window, projectOf(studio)?.world ?? '', null),
    },
    ...objectKinds.map((kind) =>
      make(
        `world.add.${kind}`,
        [],
        (world) => place(world, { what: 'object', kind, at: placeFor(world, 0.2) }),
        {
          may: (world) => (world.model.acts?.may ?? false) && (edits(world) || isObstacle(kind)),
          needs: isObstacle(kind) ? 'world' : 'file',
        },
      ),
    ),
    ...robotTypes.map((type) =>
      make(
        `world.add.${type}`,
        [],
        (world) =>
          place(world, {
            what: 'robot',
            type,
            at: placeFor(world, type === 'carbot' ? 0.25 : 0.08),
          }),
        { may: edits, needs: 'file' },
      ),
    ),
  ];

  function placeFor({ model }: ShownWorld, reach: number): Pose {
    const { x, y } = model.freePlace(reach);
    const round = optionsOf(studio).getState().snap ? 0.05 : 0;
    const at = round > 0 ? (value: number) => Math.round(value / round) * round : tidy;
    return { x: tidy(at(x)), y: tidy(at(y)), angle: 0 };
  }
}

type Need = 'world' | 'thing' | 'thingOfFile' | 'file';

/** Of what a command needs, what is missing. */
function whyNotIn(studio: Studio, world: ShownWorld | undefined, needs: Need): string {
  if (!world) return words.open;
  const ofFile = needs === 'file' || needs === 'thingOfFile';
  if (ofFile && !world.file) return words.edit;
  if (!world.file && studio.past.at !== null) return text.whyNot.looksBack;
  if (needs === 'file' || needs === 'world') return '';
  return world.model.chosen ? words.robotStays : words.select;
}

/** What can be put into a world that runs. */
export function isObstacle(kind: string): boolean {
  return kind === 'wall' || kind === 'box' || kind === 'cylinder';
}

/** The selected robot; where nothing is selected, the only one. */
function askedOf({ chosen, stage }: WorldModel): string | undefined {
  if (chosen) return chosen.kind === 'robot' ? chosen.name : undefined;
  const robots = stage.things.filter(({ kind }) => kind === 'robot');
  return robots.length === 1 ? robots[0]?.name : undefined;
}

function isRobot({ model }: ShownWorld): boolean {
  return model.chosen?.kind === 'robot';
}

function choose(model: WorldModel, by: 1 | -1): void {
  model.step(by);
  if (model.chosen) model.spoken.emit(spokenPlace(model, model.chosen));
}

function nudge(model: WorldModel, x: number, y: number, far: boolean): void {
  const step = far ? kFar : kStep;
  const moved = (pose: Pose) => ({
    ...pose,
    x: tidy(pose.x + x * step),
    y: tidy(pose.y + y * step),
  });
  if (model.placing) return model.movePlacing(moved(model.placing.at));
  const { chosen, acts } = model;
  if (chosen && acts?.may && Number.isFinite(model.poseOf(chosen).x)) {
    acts.move(chosen, moved(model.poseOf(chosen)), 'key');
    return model.spoken.emit(spokenPlace(model, chosen));
  }
  if (chosen) return;
  model.follows = null;
  model.look(panned(model.seen(), { x: -x * kPanPx, y: y * kPanPx }));
}

function turn(model: WorldModel, by: number): void {
  const turned = (pose: Pose) => ({ ...pose, angle: snapAngle(pose.angle + by, 0) });
  if (model.placing) return model.movePlacing(turned(model.placing.at));
  const { chosen, acts } = model;
  if (!chosen || !acts?.may) return;
  acts.move(chosen, turned(model.poseOf(chosen)), 'key');
  model.spoken.emit(spokenPlace(model, chosen));
}

function giveUp(model: WorldModel): void {
  if (model.placing) model.place(null);
  else model.select(null);
}

function zoom(model: WorldModel, factor: number): void {
  const { width, height } = model.screen;
  model.look(zoomed(model.seen(), model.screen, { x: width / 2, y: height / 2 }, factor));
}

function place(world: ShownWorld, placing: Placing): void {
  world.model.place(placing);
  world.focus();
}

function copy({ model, file }: ShownWorld): void {
  if (!file || model.selected === null) return;
  const added = copySteps(file.value, model.selected);
  if (!added) return;
  file.commit(added.steps);
  model.select(added.key);
}
