import { expect, test } from 'vitest';
import { Mesh, type MeshBasicMaterial, type Object3D } from 'three';
import { litLamps } from '../../../core/world/lamps';
import { WorldModel } from '../../../core/world/model';
import { bodies, type Thing } from '../../../core/world/stage';
import { Lamps } from './solid_lamps';

function model(): WorldModel {
  const made = new WorldModel();
  const thing: Thing = {
    ...{ key: 'r', name: 'r', kind: 'robot', type: 'thymio2', ...bodies.thymio2 },
    ...{ pose: { x: 1, y: 2, angle: Math.PI / 2 }, colour: [1, 1, 1], on: true, later: false },
  };
  made.setStage({ ...made.stage, name: 'w', things: [thing] });
  return made;
}

const shownIn = (lamps: Lamps) => lamps.object.children.filter((one) => one.visible);
const colourOf = (one: Object3D | undefined) =>
  one instanceof Mesh ? (one.material as MeshBasicMaterial).color.getHexString() : '';

test('ALampThatIsLitIsOnTheRoofOfItsRobotAndGoesWhenItIsOff', () => {
  const world = model();
  const lamps = new Lamps();
  const lamp = (red: number) => ({ robot: 0, at: { x: 0.05, y: 0 }, colour: [red, 0, 0] });
  world.setRays({ looks: [], lamps: [lamp(1), { ...lamp(0), at: { x: 0, y: 0 } }] });
  lamps.show(litLamps(world));
  const [lit, ...others] = shownIn(lamps);
  expect(others).toEqual([]);
  expect(lit?.position.x).toBeCloseTo(1);
  expect(lit?.position.y).toBeCloseTo(2.05);
  expect(lit?.position.z).toBeCloseTo(bodies.thymio2.height);
  expect(colourOf(lit?.children[0])).toBe('ff0000');
  world.setRays({ looks: [], lamps: [lamp(0)] });
  lamps.show(litLamps(world));
  expect(shownIn(lamps)).toEqual([]);
});
