import type { Json } from '../../../protocol/messages';
import type { JsonFile } from '../../../core/session/json_file';
import { moveSteps, numberOf, pairOf, shapeSteps, type Table } from '../../../core/world/file';
import type { Pose } from '../../../core/world/geometry';
import { SwitchField } from './fields';
import { NumberField } from './number_field';
import { PlaceFields } from './place_fields';
import { formWords } from './form_words';

export interface EditedThing {
  file: JsonFile;
  id: string;
  table: Table;
  off: boolean;
  /** False: not now. */
  set(name: string, value: Json | undefined): boolean;
}

export function PoseFields({ file, id, table, off }: EditedThing) {
  const [x, y] = pairOf(table['at']) ?? [0, 0];
  const angle = numberOf(table['angle'], 0);
  const move = (change: Partial<Pose>) =>
    file.commit(moveSteps(file.value, id, { x, y, angle, ...change }));
  return (
    <PlaceFields
      x={x}
      y={y}
      angle={angle}
      off={off}
      onMove={(toX, toY) => move({ x: toX, y: toY })}
      onTurn={(to) => to !== undefined && move({ angle: to })}
    />
  );
}

export function SizeFields({ file, id, table, off, set }: EditedThing) {
  const size = pairOf(table['size']);
  const kind = table['kind'];
  const round = table['radius'] !== undefined || kind === 'cylinder';
  const side = (label: string, index: 0 | 1) => (
    <NumberField
      label={label}
      unit="m"
      low={0.001}
      high={100}
      value={size?.[index]}
      disabled={off}
      onSet={(value) =>
        value !== undefined && size !== null && set('size', size.with(index, value))
      }
    />
  );
  const lamp = kind === 'light' || kind === 'infrared';
  return (
    <>
      {kind === 'patch' ? (
        <SwitchField
          label={formWords.round}
          on={round}
          disabled={off}
          onSet={(to) => file.commit(shapeSteps(file.value, id, to))}
        />
      ) : null}
      {round || (lamp && !size) ? (
        <NumberField
          label={formWords.radius}
          unit="m"
          low={0.001}
          high={100}
          {...(lamp ? { otherwise: '–' } : {})}
          value={table['radius'] === undefined ? undefined : numberOf(table['radius'], 0)}
          disabled={off}
          onSet={(value) => set('radius', value)}
        />
      ) : (
        <>
          {side(formWords.width, 0)}
          {side(formWords.length, 1)}
        </>
      )}
    </>
  );
}
