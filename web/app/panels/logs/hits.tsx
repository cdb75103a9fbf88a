import type { LogRow } from '../../../core/logs';
import { shownTime } from '../../../core/numbers';
import { nameOf } from '../../documents';
import { useStudio } from '../../hooks';
import { VirtualRows } from '../../parts/virtual_rows';
import { usePastTime } from '../../past_hooks';
import { revealPlace } from './reveal_place';
import { logWords as words, placeName } from './words';

/** All times that the places were reached. A click or Enter: everything shows that instant. */
export function Hits({ rows }: { rows: readonly LogRow[] }) {
  const studio = useStudio();
  const at = usePastTime();
  const open = ({ t, point }: LogRow) => {
    studio.past.look(t);
    revealPlace(studio, point.place);
  };
  return (
    <VirtualRows
      rows={rows}
      label={words.hits}
      keyOf={({ key }) => key}
      onRowKey={(row, event) => {
        if (event.key !== 'Enter') return;
        event.preventDefault();
        open(row);
      }}
    >
      {(row) => (
        <button
          type="button"
          tabIndex={-1}
          className={at !== null && Math.abs(at - row.t) < 5e-4 ? 'logs__hit is-on' : 'logs__hit'}
          onClick={() => open(row)}
        >
          <time className="num">{shownTime(row.t)}</time>
          <span className="logs__at ellipsis">
            {placeName(row.point.place, (doc) => nameOf(studio, doc))}
            {row.where.includes('/') ? ` (${row.where.slice(0, row.where.indexOf('/'))})` : ''}
          </span>
          <span className="logs__values ellipsis">
            {row.values.map(({ name, text }, index) => (
              <span key={index} className="logs__value">
                {name} <code>{text}</code>
              </span>
            ))}
          </span>
        </button>
      )}
    </VirtualRows>
  );
}
