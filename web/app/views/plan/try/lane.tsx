import { IconBolt, IconChevronRight } from '@tabler/icons-react';
import type { Trying, Turn } from '../../../../core/plan/trying';
import { kStroke } from '../../../parts/icons';
import { tryWords as words } from './words';

/** Who was active and how that ended, in their order; a click goes back to there. */
export function Lane({ trying, turns }: { trying: Trying; turns: readonly Turn[] }) {
  return (
    <ol className="ptry__lane" aria-label={words.lane}>
      {turns.map((turn, at) => (
        // Nothing else tells two of the same actor apart.
        <li key={at}>
          <button
            type="button"
            className={turn.to === undefined ? 'ptry__turn is-active' : 'ptry__turn'}
            aria-current={turn.to === undefined ? 'step' : undefined}
            title={words.toBeginning(nameOf(turn))}
            onClick={() => void trying.backTo(turn)}
          >
            <b>{nameOf(turn)}</b>{' '}
            {turn.end === undefined ? null : (
              <span className="ptry__end">
                {turn.interrupted ? (
                  <IconBolt size={12} stroke={kStroke} aria-hidden />
                ) : (
                  <IconChevronRight size={12} stroke={kStroke} aria-hidden />
                )}
                {turn.end}
              </span>
            )}
          </button>
        </li>
      ))}
    </ol>
  );
}

/** Inside a sub-plan with its callers. */
const nameOf = ({ path, actor }: Turn): string => [...path.split('/').slice(1), actor].join('/');
