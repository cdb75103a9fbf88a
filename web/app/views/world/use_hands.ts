// The mouse and fingers on the picture of a world: choose, drag, turn, pan, zoom, put down.

import { useEffect, useRef, type RefObject } from 'react';
import { radians, type Point } from '../../../core/world/geometry';
import type { Standing } from '../../../core/world/hit';
import type { WorldModel } from '../../../core/world/model';
import { kSnapAngle, kSnapM, snapAngle, snapPoint } from '../../../core/world/snap';

/** How a picture tells what is under a point of the screen. */
export interface Eye {
  meet(at: Point): { hit: Standing | undefined; ground: Point | null; onHandle: boolean };
  /** The picture moves under the hand; null: it moves by itself (orbit). */
  pan: ((by: Point) => void) | null;
  zoom: ((at: Point, factor: number) => void) | null;
  /** A thing is held: the picture keeps still. */
  hold(held: boolean): void;
}

type Grip =
  | { is: 'thing'; key: string; offset: Point; since: number; moved: boolean }
  | { is: 'handle'; key: string }
  | { is: 'view'; moved: boolean };

/** A press that moves less than this is a click, in pixels. */
const kClickPx = 4;
/** A press that lasts longer holds what it is on, also where it moves by itself, in ms. */
const kGrabMs = 200;
const kWheelTurn = radians(5);

export function useHands(
  frame: RefObject<HTMLElement | null>,
  model: WorldModel,
  eye: RefObject<Eye | null>,
  snaps: boolean,
  openMenu: (at: Point) => void,
): void {
  const snapping = useRef(snaps);
  useEffect(() => void (snapping.current = snaps), [snaps]);
  useEffect(() => {
    const place = frame.current;
    if (!place) return;
    return attach(place, model, eye, () => snapping.current, openMenu);
  }, [frame, model, eye, openMenu]);
}

function attach(
  place: HTMLElement,
  model: WorldModel,
  eye: RefObject<Eye | null>,
  snaps: () => boolean,
  openMenu: (at: Point) => void,
): () => void {
  let grip: Grip | null = null;
  let begin: Point = { x: 0, y: 0 };
  let last: Point = { x: 0, y: 0 };
  /** A finger is on what was chosen already. */
  let tapped = false;

  const pointOf = (event: MouseEvent): Point => {
    const frame = place.getBoundingClientRect();
    return { x: event.clientX - frame.left, y: event.clientY - frame.top };
  };
  const step = (event: MouseEvent) => (snaps() && model.acts?.edits && !event.altKey ? kSnapM : 0);
  const may = () => model.acts?.may ?? false;

  const down = (event: PointerEvent) => {
    if (!(event.target instanceof HTMLCanvasElement)) return;
    const at = (begin = last = pointOf(event));
    tapped = false;
    const now = eye.current;
    if (!now) return;
    place.focus({ preventScroll: true });
    if (model.placing && event.button === 0) return putDown(model);
    if (event.button !== 0) return void (grip = now.pan ? { is: 'view', moved: true } : null);
    const { hit, ground, onHandle } = now.meet(at);
    if (onHandle && model.selected !== null && may()) grip = { is: 'handle', key: model.selected };
    else if (hit && ground) {
      tapped = event.pointerType === 'touch' && model.selected === hit.thing.key;
      model.select(hit.thing.key);
      const offset = { x: hit.pose.x - ground.x, y: hit.pose.y - ground.y };
      const since = performance.now();
      grip = { is: 'thing', key: hit.thing.key, offset, since, moved: false };
    } else grip = { is: 'view', moved: false };
    if (grip.is !== 'view') {
      now.hold(true);
      event.stopPropagation();
    }
    if (grip.is !== 'view' || now.pan) capture(place, event.pointerId);
  };

  const move = (event: PointerEvent) => {
    const at = pointOf(event);
    const now = eye.current;
    if (!now) return;
    const by = { x: at.x - last.x, y: at.y - last.y };
    last = at;
    const far = Math.hypot(at.x - begin.x, at.y - begin.y) > kClickPx;
    if (model.placing) {
      const { ground } = now.meet(at);
      if (ground)
        model.movePlacing({
          ...snapPoint(ground, step(event)),
          angle: model.placing.at.angle,
        });
      return;
    }
    if (!grip) return hover(at, now);
    if (grip.is === 'view') {
      grip.moved ||= far;
      if (grip.moved) now.pan?.(by);
      return;
    }
    const thing = model.thing(grip.key);
    const { ground } = now.meet(at);
    if (!thing || !ground || !may()) return;
    if (grip.is === 'handle') {
      const pose = model.poseOf(thing);
      const angle = Math.atan2(ground.y - pose.y, ground.x - pose.x);
      model.turning = true;
      const round = step(event) > 0 !== event.shiftKey ? kSnapAngle : 0;
      return model.acts?.move(thing, { ...pose, angle: snapAngle(angle, round) }, 'holds');
    }
    grip.moved ||= far;
    if (!grip.moved) return;
    const to = snapPoint({ x: ground.x + grip.offset.x, y: ground.y + grip.offset.y }, step(event));
    model.acts?.move(thing, { ...to, angle: model.poseOf(thing).angle }, 'holds');
  };

  /** With each frame: a robot that is pressed on for longer than a click drives no farther. */
  const grab = () => {
    const { acts } = model;
    if (grip?.is !== 'thing' || grip.moved || !acts?.may || acts.edits) return;
    if (performance.now() - grip.since < kGrabMs) return;
    const thing = model.thing(grip.key);
    const ground = eye.current?.meet(last).ground;
    if (!thing || !ground) return;
    const pose = model.poseOf(thing);
    grip.offset = { x: pose.x - ground.x, y: pose.y - ground.y };
    grip.moved = true;
    acts.move(thing, pose, 'holds');
  };

  const hover = (at: Point, now: Eye) => {
    const { hit, onHandle } = now.meet(at);
    model.hover(onHandle ? null : (hit?.thing.key ?? null));
    place.dataset['over'] = onHandle ? 'handle' : hit && may() ? 'thing' : 'none';
  };

  const up = (event: Pick<PointerEvent, 'type'>) => {
    const held = grip;
    grip = null;
    if (!held) return;
    eye.current?.hold(false);
    if (held.is === 'view') {
      if (!held.moved && event.type === 'pointerup') model.select(null);
      return;
    }
    model.turning = false;
    const thing = model.thing(held.key);
    if (thing && (held.is === 'handle' || held.moved))
      model.acts?.move(thing, model.poseOf(thing), 'done');
  };

  const wheel = (event: WheelEvent) => {
    const now = eye.current;
    if (grip?.is === 'thing') {
      // What is held turns.
      event.preventDefault();
      event.stopPropagation();
      const thing = model.thing(grip.key);
      if (!thing) return;
      const pose = model.poseOf(thing);
      grip.moved = true;
      const angle = pose.angle + (event.deltaY > 0 ? -kWheelTurn : kWheelTurn);
      model.acts?.move(thing, { ...pose, angle: snapAngle(angle, 0) }, 'holds');
    } else if (now?.zoom) {
      event.preventDefault();
      now.zoom(pointOf(event), Math.exp(-event.deltaY * 0.0015));
    }
  };

  const leave = () => {
    model.hover(null);
    place.dataset['over'] = 'none';
  };
  /** Of the robot under the pointer or, by a key, of the chosen one. Beside a robot the picture is moved. */
  const menu = (event: MouseEvent) => {
    event.preventDefault();
    const byPointer = event.button === 2;
    const hit = byPointer ? eye.current?.meet(pointOf(event)).hit : undefined;
    const thing = byPointer ? hit?.thing : model.chosen;
    if (thing?.kind !== 'robot' || model.placing) return;
    if (grip) up({ type: 'pointercancel' });
    model.select(thing.key);
    const { width, height } = place.getBoundingClientRect();
    openMenu(byPointer ? pointOf(event) : { x: width / 2, y: height / 2 });
  };
  /** A finger has no other button: a second tap on a robot is for its menu. */
  const click = () => {
    const stayed = Math.hypot(last.x - begin.x, last.y - begin.y) <= kClickPx;
    if (tapped && stayed && model.chosen?.kind === 'robot') openMenu(last);
    tapped = false;
  };

  const listen: [string, (event: never) => void, AddEventListenerOptions?][] = [
    // First: what is held is not to move the picture as well.
    ['pointerdown', down, { capture: true }],
    ['pointermove', move],
    ['pointerup', up],
    ['pointercancel', up],
    ['pointerleave', leave],
    ['wheel', wheel, { passive: false, capture: true }],
    ['contextmenu', menu],
    ['click', click],
  ];
  for (const [name, act, options] of listen)
    place.addEventListener(name, act as EventListener, options);
  const off = model.drawn.on(grab);
  return () => {
    off();
    // What is held when the picture goes is let go.
    up({ type: 'pointercancel' });
    for (const [name, act, options] of listen)
      place.removeEventListener(name, act as EventListener, options);
  };
}

/** Puts down what is being placed, and ends placing. */
export function putDown(model: WorldModel): void {
  const { placing } = model;
  if (!placing) return;
  model.place(null);
  model.acts?.put(placing);
}

function capture(place: HTMLElement, pointer: number): void {
  try {
    place.setPointerCapture(pointer);
  } catch {
    // The pointer is gone already.
  }
}
