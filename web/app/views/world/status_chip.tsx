import { useEffect, useRef } from 'react';
import type { Pose } from '../../../core/world/geometry';
import type { WorldModel } from '../../../core/world/model';
import { text } from '../../text';

/** How often numbers over the picture change, in ms: they are to be read. */
const kEveryMs = 200;

/** Time, and how fast the robot drives; written past React. */
export function StatusChip({ model }: { model: WorldModel }) {
  const chip = useRef<HTMLParagraphElement>(null);
  useEffect(() => {
    let before: { t: number; pose: Pose } | null = null;
    const write = () => {
      const robot = model.thing(model.follows) ?? model.chosen ?? model.robotAt(0);
      const pose = robot && model.poseOf(robot);
      if (!chip.current) return;
      const known = pose !== undefined && Number.isFinite(pose.x);
      chip.current.hidden = !known;
      if (!known) return;
      const passed = before ? model.t - before.t : 0;
      const speed =
        before && passed > 0
          ? (Math.hypot(pose.x - before.pose.x, pose.y - before.pose.y) / passed) * 100
          : 0;
      if (!before || passed > 0 || model.t < before.t) before = { t: model.t, pose };
      const drives = robot?.kind === 'robot' ? ` · ${text.world.speedOf(speed.toFixed(0))}` : '';
      chip.current.textContent = `${model.t.toFixed(1)} s${drives}`;
    };
    write();
    const timer = setInterval(write, kEveryMs);
    return () => clearInterval(timer);
  }, [model]);
  return <p className="world__chip num" ref={chip} hidden />;
}
