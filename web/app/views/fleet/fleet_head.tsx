import { IconHandStop } from '@tabler/icons-react';
import { doings } from '../../../core/fleet';
import { usePart } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { DoingSign } from './doing_sign';
import { useCounts, useFleetDesk } from './use_fleet';
import { words } from './words';

/** Which fleet, how its robots are, and Stop for all of them: it stays in sight. */
export function FleetHead() {
  const desk = useFleetDesk();
  const fleet = usePart('fleet', {}, (is) => is?.fleet ?? '');
  const user = usePart('fleet', {}, (is) => is?.user ?? '');
  const count = usePart('fleet', {}, (is) => Object.keys(is?.robots ?? {}).length);
  const counts = useCounts();
  return (
    <div className="fhead" data-region="fleet">
      <h1 className="fhead__title ellipsis">{words.title(fleet)}</h1>
      <span className="muted">
        {words.count(count)}
        {user === '' ? '' : ` · ${words.as(user)}`}
      </span>
      <div className="fhead__counts">
        {doings
          .filter((doing) => counts[doing] > 0)
          .map((doing) => (
            <button
              key={doing}
              type="button"
              className="fcount"
              aria-label={words.show(counts[doing], words.doing[doing])}
              data-tip={words.doingHelp[doing]}
              aria-pressed={desk.query === words.doing[doing]}
              onClick={() =>
                desk.set({ query: desk.query === words.doing[doing] ? '' : words.doing[doing] })
              }
            >
              <DoingSign doing={doing} />
              <span className="num">{counts[doing]}</span> {words.doing[doing]}
            </button>
          ))}
      </div>
      <Button
        className="fstop"
        tip={words.stopAllTip}
        keys="Shift+F5"
        icon={<IconHandStop size={16} stroke={kStroke} aria-hidden />}
        onClick={() => void desk.order('stop', null)}
      >
        {words.stopAll}
      </Button>
    </div>
  );
}
