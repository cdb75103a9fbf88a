import type { Point } from '../../../core/world/geometry';
import { CommandItem, StudioMenu } from '../../parts/menu';
import { text } from '../../text';

/** What can be done with the robot that is chosen. */
export default function RobotMenu({ at, onClose }: { at: Point; onClose: () => void }) {
  return (
    <StudioMenu
      opened
      onChange={(open) => open || onClose()}
      button={<span className="world__menuat" style={{ left: at.x, top: at.y }} />}
    >
      <CommandItem id="world.why" title={text.why.menu} />
      <CommandItem id="world.follow" />
    </StudioMenu>
  );
}
