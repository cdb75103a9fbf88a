import { entryOf, pairOf, setSteps } from '../../../core/world/file';
import { degrees, radians } from '../../../core/world/geometry';
import { tidy } from '../../../core/world/snap';
import { text } from '../../text';
import type { EditedEntry } from './entry_form';
import { NumberField } from './number_field';

const words = text.world;

/** Where an entry moves something to. */
export function EntryTarget({ file, id, off }: EditedEntry) {
  const entry = entryOf(file.value, id);
  const [x, y] = pairOf(entry['at']) ?? [0, 0];
  const angle = entry['angle'];
  const set = (at: [number, number]) => file.commit(setSteps(file.value, id, 'at', at));
  return (
    <>
      <NumberField
        label={words.x}
        unit="m"
        value={x}
        disabled={off}
        onSet={(to) => to !== undefined && set([to, y])}
      />
      <NumberField
        label={words.y}
        unit="m"
        value={y}
        disabled={off}
        onSet={(to) => to !== undefined && set([x, to])}
      />
      <NumberField
        label={words.angle}
        unit="°"
        step={1}
        otherwise="–"
        value={typeof angle === 'number' ? Math.round(degrees(angle) * 100) / 100 : undefined}
        disabled={off}
        onSet={(to) =>
          file.commit(
            setSteps(file.value, id, 'angle', to === undefined ? undefined : tidy(radians(to))),
          )
        }
      />
    </>
  );
}
