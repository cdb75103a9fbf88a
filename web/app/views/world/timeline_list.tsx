import { IconPlus } from '@tabler/icons-react';
import { useEffect, useReducer } from 'react';
import type { JsonFile } from '../../../core/session/json_file';
import { keyOf, listOf, newEntry, numberOf, tableOf } from '../../../core/world/file';
import type { WorldModel } from '../../../core/world/model';
import { useDrives } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { useModel } from './desk';
import { entryText } from './entry_text';
import { formWords } from './form_words';

/** What happens by itself in a world, in the order of time. */
export function TimelineList({ file, model }: { file: JsonFile; model: WorldModel }) {
  const drives = useDrives();
  const { entry, selected } = useModel(model);
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => file.changed.on(redraw), [file]);
  const entries = listOf(tableOf(file.value), 'timeline');
  const add = () => {
    const last = entries.reduce<number>(
      (most, one) => Math.max(most, numberOf(tableOf(one)['t'], 0)),
      0,
    );
    const added = newEntry(file.value, entries.length > 0 ? last + 10 : 10, 'add');
    file.commit(added.steps);
    model.selectEntry(added.key);
  };
  return (
    <section className="things" aria-label={formWords.timeline}>
      <header className="things__head">
        <h2>{formWords.timeline}</h2>
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={formWords.entry}
          icon={<IconPlus size={14} stroke={kStroke} />}
          onClick={add}
        />
      </header>
      <ul>
        {entries.map((_, index) => {
          const key = keyOf({ list: 'timeline', index });
          const { t, what } = entryText(file.value, key);
          const on = entry === key || selected === key;
          return (
            <li key={key}>
              <button
                type="button"
                className={on ? 'entry is-on' : 'entry'}
                aria-pressed={on}
                data-inset
                onClick={() => model.selectEntry(on ? null : key)}
              >
                <span className="entry__t num">{t}</span>
                <span className="ellipsis">{what}</span>
              </button>
            </li>
          );
        })}
      </ul>
      {entries.length === 0 ? <p className="quiet">{formWords.noEntries}</p> : null}
    </section>
  );
}
