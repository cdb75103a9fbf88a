import { layoutNames } from '../../core/layouts';
import { chooseLayout } from '../commands/view_commands';
import { useStudio, useWindow } from '../hooks';
import { Segments } from '../parts/segments';
import { text } from '../text';

const segments = layoutNames.map((value) => ({ value, words: text.layouts[value] }));

/** Draw, Script, Debug, Present. */
export function LayoutSwitch() {
  const studio = useStudio();
  const chosen = useWindow((state) => state.layout);
  return (
    <Segments
      label={text.layout}
      segments={segments}
      chosen={chosen}
      onChoose={(layout) => chooseLayout(studio, layout)}
    />
  );
}
