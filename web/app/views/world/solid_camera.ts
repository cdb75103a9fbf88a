// Turns around the world in 3D, and tells what the pointer meets.

import { PerspectiveCamera, Raycaster, Vector2, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { distance, reachOf } from '../../../core/world/geometry';
import { thingOnRay } from '../../../core/world/hit';
import type { WorldModel } from '../../../core/world/model';
import type { SolidStage } from './solid_stage';
import type { Eye } from './use_hands';

/** Metres beside a thing that still mean it, for each metre of distance. */
const kSlack = 0.008;

export class SolidCamera {
  readonly eye: Eye;
  private readonly controls: OrbitControls;
  private readonly endFollowing: () => void;

  constructor(model: WorldModel, stage: SolidStage) {
    const { camera, element } = stage;
    const controls = new OrbitControls(camera, element);
    this.controls = controls;
    // The keys are the world's own.
    controls.enableDamping = false;
    controls.maxPolarAngle = Math.PI / 2 - 0.03;
    controls.minDistance = 0.1;
    controls.addEventListener('change', () => stage.ask());
    this.endFollowing = followModel(model, camera, controls);
    this.eye = eyeOf(model, camera, controls, element);
  }

  end(): void {
    this.endFollowing();
    this.controls.dispose();
  }
}

/** Fits the world when asked, and goes with the robot that is followed. */
function followModel(
  model: WorldModel,
  camera: PerspectiveCamera,
  controls: OrbitControls,
): () => void {
  // At first it has to look somewhere, also where a hand has moved the view from above.
  let fitted: string | null = null;
  const update = () => {
    const { width, height } = model.stage;
    const wanted = `${width} ${height} ${camera.aspect}`;
    if (fitted === null || (model.fits && fitted !== wanted)) fit(camera, controls, width, height);
    fitted = model.fits ? wanted : '';
    const followed = model.thing(model.follows);
    const pose = followed && model.poseOf(followed);
    if (pose && Number.isFinite(pose.x)) {
      const by = new Vector3(pose.x - controls.target.x, pose.y - controls.target.y, 0);
      camera.position.add(by);
      controls.target.add(by);
      controls.update();
    }
  };
  const byHand = () => {
    model.fits = false;
  };
  controls.addEventListener('start', byHand);
  update();
  return model.drawn.on(update);
}

function fit(
  camera: PerspectiveCamera,
  controls: OrbitControls,
  width: number,
  height: number,
): void {
  const vertical = (camera.fov * Math.PI) / 360;
  const across = Math.atan(Math.tan(vertical) * camera.aspect);
  // Seen at an angle the ground is shorter; its near edge is wider.
  const away = Math.max(
    (width / 2 / Math.tan(across)) * 1.12 + height * 0.3,
    (height / 2 / Math.tan(vertical)) * 1.05,
  );
  const tilt = (52 * Math.PI) / 180;
  controls.target.set(width / 2, height / 2 - height * 0.03, 0);
  camera.position.set(width / 2, height / 2 - Math.cos(tilt) * away, Math.sin(tilt) * away);
  camera.updateProjectionMatrix();
  controls.update();
}

function eyeOf(
  model: WorldModel,
  camera: PerspectiveCamera,
  controls: OrbitControls,
  element: HTMLElement,
): Eye {
  const caster = new Raycaster();
  return {
    meet(at) {
      const { clientWidth: width, clientHeight: height } = element;
      caster.setFromCamera(new Vector2((at.x / width) * 2 - 1, 1 - (at.y / height) * 2), camera);
      const { origin, direction } = caster.ray;
      const slack = kSlack * origin.distanceTo(controls.target);
      const met = thingOnRay(model.standing(), { from: origin, way: direction }, slack);
      const chosen = model.chosen;
      const handle = chosen && handleIn3d(model, chosen.key);
      const onHandle =
        handle !== undefined && met.ground !== null && distance(handle, met.ground) < slack * 2.5;
      return { ...met, onHandle };
    },
    pan: null,
    zoom: null,
    hold(held) {
      controls.enabled = !held;
    },
  };
}

/** On the ground ahead of the thing, so far that its body does not hide it. */
export function handleIn3d(model: WorldModel, key: string): { x: number; y: number } | undefined {
  const thing = model.thing(key);
  const pose = thing && model.poseOf(thing);
  if (!pose || !Number.isFinite(pose.x)) return undefined;
  const away = reachOf(thing.shape) * 1.3 + 0.05 * Math.max(model.stage.width, 1) * 0.5;
  return { x: pose.x + Math.cos(pose.angle) * away, y: pose.y + Math.sin(pose.angle) * away };
}
