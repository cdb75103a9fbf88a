import type { JsonFile } from '../../../core/session/json_file';
import { entryOf, pairOf, setSteps } from '../../../core/world/file';
import { tidy } from '../../../core/world/snap';
import { PlaceFields } from './place_fields';

export interface EditedEntry {
  file: JsonFile;
  id: string;
  off: boolean;
}

/** Where an entry moves something to. */
export function EntryTarget({ file, id, off }: EditedEntry) {
  const entry = entryOf(file.value, id);
  const [x, y] = pairOf(entry['at']) ?? [0, 0];
  const angle = entry['angle'];
  return (
    <PlaceFields
      x={x}
      y={y}
      angle={typeof angle === 'number' ? angle : undefined}
      off={off}
      angleMayBeOpen
      onMove={(toX, toY) => file.commit(setSteps(file.value, id, 'at', [toX, toY]))}
      onTurn={(to) =>
        file.commit(setSteps(file.value, id, 'angle', to === undefined ? undefined : tidy(to)))
      }
    />
  );
}
