import { Segments } from '../../parts/segments';
import { formWords } from './form_words';

const worldModes = ['live', 'edit', 'text'] as const;
export type WorldMode = (typeof worldModes)[number];

const segments = worldModes.map((value) => ({
  value,
  words: formWords.modes[value],
  tip: formWords.modeTips[value],
}));

/** The same world three times: as it runs, its file drawn, its file as text. */
export function ModeSwitch(props: {
  mode: WorldMode;
  /** Each mode has a bar of its own: this one comes in place of that in which it was chosen. */
  takesFocus: boolean;
  onChange: (mode: WorldMode) => void;
}) {
  return (
    <Segments
      small
      takesFocus={props.takesFocus}
      label={formWords.mode}
      segments={segments}
      chosen={props.mode}
      onChoose={props.onChange}
    />
  );
}
