import { useCallback } from 'react';
import type { Colour, Json } from '../../../protocol/messages';
import type { JsonFile } from '../../../core/session/json_file';
import {
  colourOf,
  kindSteps,
  numberOf,
  partOfKey,
  setSteps,
  tableAt,
  textOf,
} from '../../../core/world/file';
import { isObjectKind, objectKinds, type ObjectKind } from '../../../core/world/stage';
import { useDrives } from '../../hooks';
import { text } from '../../text';
import { ColourField } from './colour_field';
import { ChoiceField, TextField } from './fields';
import { NumberField } from './number_field';
import { PoseFields, SizeFields, type EditedThing } from './pose_fields';
import { RobotFields } from './robot_fields';
import { formWords } from './form_words';

const words = text.world;
const grey: Colour = [0.9, 0.9, 0.9];

/** An object or robot as it is in the file. */
export function FileForm({ file, id }: { file: JsonFile; id: string }) {
  const off = !useDrives();
  const table = tableAt(file.value, id);
  const set = useCallback(
    (name: string, value: Json | undefined) => file.commit(setSteps(file.value, id, name, value)),
    [file, id],
  );
  const edited: EditedThing = { file, id, table, off, set };
  return partOfKey(id)?.list === 'robots' ? (
    <RobotFields {...edited} />
  ) : (
    <ObjectFields {...edited} />
  );
}

function ObjectFields(edited: EditedThing) {
  const { file, id, table, off, set } = edited;
  const setColour = useCallback((value: Colour) => set('colour', value), [set]);
  const kind = isObjectKind(table['kind']) ? table['kind'] : 'box';
  return (
    <>
      <TextField
        label={formWords.id}
        value={textOf(table['id'])}
        disabled={off}
        onSet={(value) => set('id', value === '' ? undefined : value)}
      />
      <ChoiceField<ObjectKind>
        label={formWords.kind}
        value={kind}
        choices={objectKinds.map((one) => ({ value: one, label: words.kinds[one] }))}
        disabled={off}
        onSet={(value) => file.commit(kindSteps(file.value, id, value))}
      />
      <PoseFields {...edited} />
      <SizeFields {...edited} />
      <NumberField
        label={formWords.height}
        unit="m"
        low={0.001}
        high={100}
        otherwise="0.1"
        value={table['height'] === undefined ? undefined : numberOf(table['height'], 0.1)}
        disabled={off}
        onSet={(value) => set('height', value)}
      />
      {kind === 'box' || kind === 'cylinder' ? (
        <NumberField
          label={formWords.mass}
          unit="kg"
          low={0}
          high={1000}
          step={0.1}
          otherwise="0"
          value={table['mass'] === undefined ? undefined : numberOf(table['mass'], 0)}
          disabled={off}
          onSet={(value) => set('mass', value)}
        />
      ) : null}
      <ColourField
        label={formWords.colour}
        value={colourOf(table['colour']) ?? grey}
        disabled={off}
        onSet={setColour}
      />
    </>
  );
}
