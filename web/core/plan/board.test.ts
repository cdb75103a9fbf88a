// What a board does bit by bit ends, whatever its plan is.
import { expect, it } from 'vitest';
import { JsonFile } from '../session/json_file';
import { TextSession } from '../session/text_session';
import { seeded } from '../test_seeded';
import { kFinishMsMax, PlanBoard } from './board';
import { longPlan, toolboxes } from './test_plans';

/** A board of that plan, on a clock that runs on by so much whenever it is read. */
function boardOf(actors: number, step: number) {
  const file = new JsonFile(
    new TextSession(JSON.stringify(longPlan(seeded(1), actors)), 'json'),
    () => 0,
  );
  let now = 0;
  const waiting: (() => void)[] = [];
  const turns = {
    now: () => (now += step),
    later: (act: () => void) => void waiting.push(act),
  };
  const board = new PlanBoard('P.plan.json', file, toolboxes, turns);
  /** How many turns it took until nothing was left to do. */
  const finish = () => {
    let count = 0;
    for (let act = waiting.shift(); act; act = waiting.shift(), count++) act();
    return count;
  };
  return { board, finish };
}

it('ways are looked for until their time is over; what has none then is drawn and said', () => {
  const step = 1000;
  const { board, finish } = boardOf(40, step);
  // A turn reads the clock at its begin, for its end, after an arrow, and at its own end: 3 steps of work.
  expect(finish()).toBe(kFinishMsMax / (3 * step));
  expect(board.isCut).toBe(true);
  expect(board.drawing.routes.size).toBeGreaterThanOrEqual(board.drawing.arrows.length);
});

it('a drawing that is finished in time is not cut', () => {
  const { board, finish } = boardOf(6, 1);
  finish();
  expect(board.drawing.isSketch).toBe(false);
  expect(board.isCut).toBe(false);
});

it('after a cut the next change goes on where it ended', () => {
  const { board, finish } = boardOf(12, 1000);
  finish();
  expect(board.isCut).toBe(true);
  const found = () => board.isCut;
  // Each change has the same time again, and keeps the ways that are found.
  for (let change = 0; change < 20 && found(); change++) {
    board.refresh();
    finish();
  }
  expect(board.drawing.isSketch).toBe(false);
});
