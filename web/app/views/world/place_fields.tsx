import { radians, shownDegrees } from '../../../core/world/geometry';
import { text } from '../../text';
import { NumberField } from './number_field';

const words = text.world;

/** Where something is: metres, and an angle in radians that may be left open. */
export function PlaceFields(props: {
  x: number;
  y: number;
  angle: number | undefined;
  off: boolean;
  angleMayBeOpen?: boolean;
  /** False: not now. */
  onMove(x: number, y: number): boolean | void;
  onTurn(angle: number | undefined): boolean | void;
}) {
  const { x, y, angle, off, onMove, onTurn } = props;
  return (
    <>
      <NumberField
        label={words.x}
        unit="m"
        value={x}
        disabled={off}
        onSet={(to) => to !== undefined && onMove(to, y)}
      />
      <NumberField
        label={words.y}
        unit="m"
        value={y}
        disabled={off}
        onSet={(to) => to !== undefined && onMove(x, to)}
      />
      <NumberField
        label={words.angle}
        unit="°"
        step={1}
        {...(props.angleMayBeOpen ? { otherwise: '–' } : {})}
        value={angle === undefined ? undefined : Math.round(shownDegrees(angle) * 100) / 100}
        disabled={off}
        onSet={(to) => onTurn(to === undefined ? undefined : radians(to))}
      />
    </>
  );
}
