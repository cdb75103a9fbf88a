import { useCallback } from 'react';
import type { Colour, Json } from '../../../protocol/messages';
import type { JsonFile } from '../../../core/session/json_file';
import { colourOf, numberOf, pairOf, setSteps, tableOf, textOf } from '../../../core/world/file';
import { useDrives } from '../../hooks';
import { ColourField } from './colour_field';
import { SwitchField, TextField } from './fields';
import { NumberField } from './number_field';
import { formWords } from './form_words';

const white: Colour = [1, 1, 1];

/** The world itself: nothing is chosen. */
export function WorldForm({ file }: { file: JsonFile }) {
  const off = !useDrives();
  const world = tableOf(file.value);
  const [width, height] = pairOf(world['size']) ?? [1, 1];
  const ground = tableOf(world['ground']);
  const set = useCallback(
    (name: string, value: Json | undefined) => file.commit(setSteps(file.value, null, name, value)),
    [file],
  );
  const setGround = useCallback((colour: Colour) => set('ground', { colour }), [set]);
  const side = (label: string, value: number, size: (value: number) => Json) => (
    <NumberField
      label={label}
      unit="m"
      low={0.2}
      high={100}
      step={0.1}
      value={value}
      disabled={off}
      onSet={(to) => to !== undefined && set('size', size(to))}
    />
  );
  return (
    <>
      <TextField
        label={formWords.title}
        value={textOf(world['name'])}
        disabled={off}
        onSet={(value) => set('name', value === '' ? undefined : value)}
      />
      <TextField
        label={formWords.help}
        value={textOf(world['help'])}
        disabled={off}
        onSet={(value) => set('help', value === '' ? undefined : value)}
      />
      {side(formWords.width, width, (to) => [to, height])}
      {side(formWords.length, height, (to) => [width, to])}
      <SwitchField
        label={formWords.border}
        on={world['open'] !== true}
        disabled={off}
        onSet={(on) => set('open', on ? undefined : true)}
      />
      {ground['image'] === undefined ? (
        <ColourField
          label={formWords.ground}
          value={colourOf(ground['colour']) ?? white}
          disabled={off}
          onSet={setGround}
        />
      ) : null}
      <TextField
        label={formWords.image}
        value={textOf(ground['image'])}
        otherwise="floor.png"
        disabled={off}
        onSet={(image) => set('ground', image === '' ? undefined : { image })}
      />
      <NumberField
        label={formWords.seed}
        low={0}
        high={Number.MAX_SAFE_INTEGER}
        step={1}
        whole
        otherwise="1"
        value={world['seed'] === undefined ? undefined : numberOf(world['seed'], 1)}
        disabled={off}
        onSet={(value) => set('seed', value)}
      />
    </>
  );
}
