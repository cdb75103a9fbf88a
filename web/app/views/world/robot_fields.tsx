import { useCallback } from 'react';
import type { Colour } from '../../../protocol/messages';
import { colourOf, textOf } from '../../../core/world/file';
import { robotTypes } from '../../../core/world/stage';
import { text } from '../../text';
import { ColourField } from './colour_field';
import { ChoiceField, TextField } from './fields';
import { NumberField } from './number_field';
import { PoseFields, type EditedThing } from './pose_fields';
import { formWords } from './form_words';

const words = text.world;
const white: Colour = [0.95, 0.95, 0.95];

/** A robot as it is in the file. */
export function RobotFields(edited: EditedThing) {
  const { table, off, set } = edited;
  const setPaint = useCallback((value: Colour) => set('paint', value), [set]);
  return (
    <>
      <TextField
        label={words.name}
        value={textOf(table['name'])}
        disabled={off}
        onSet={(value) => set('name', value)}
      />
      <ChoiceField
        label={formWords.type}
        value={textOf(table['type'])}
        choices={robotTypes.map((type) => ({
          value: type,
          label: words.types[type],
        }))}
        disabled={off}
        onSet={(value) => set('type', value)}
      />
      <PoseFields {...edited} />
      <TextField
        label={formWords.script}
        value={textOf(table['script'])}
        disabled={off}
        onSet={(value) => set('script', value === '' ? undefined : value)}
      />
      <Whole edited={edited} name="node" label={formWords.node} low={1} high={65534} />
      <Whole edited={edited} name="port" label={formWords.port} low={0} high={65535} />
      <ColourField
        label={formWords.paint}
        value={colourOf(table['paint']) ?? white}
        disabled={off}
        onSet={setPaint}
      />
    </>
  );
}

function Whole(props: {
  edited: EditedThing;
  name: string;
  label: string;
  low: number;
  high: number;
}) {
  const { edited, name, label, low, high } = props;
  const value = edited.table[name];
  return (
    <NumberField
      label={label}
      low={low}
      high={high}
      step={1}
      whole
      otherwise="–"
      value={typeof value === 'number' ? value : undefined}
      disabled={edited.off}
      onSet={(to) => edited.set(name, to)}
    />
  );
}
