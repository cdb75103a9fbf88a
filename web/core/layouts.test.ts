import { expect, it } from 'vitest';
import { filled, kindsOpened, layoutPlans } from './layouts';

const { Present } = layoutPlans;

it('Present has no empty panel: scripts without a plan, and no world without one', () => {
  expect(filled(Present, { plan: true, world: true })).toEqual(Present);
  const alone = filled(Present, { plan: true, world: false });
  expect(alone.parts).toEqual([{ is: 'documents', takes: ['plan'], opens: ['plan'] }]);
  expect(kindsOpened(filled(Present, { plan: false, world: false }))).toEqual(['script']);
  const world = filled(Present, { plan: false, world: true });
  expect(world.parts).toEqual([layoutPlans.Present.parts[1]]);
});
