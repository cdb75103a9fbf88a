import { IconEye, IconEyeClosed } from '@tabler/icons-react';
import type { PlanSupervisor } from '../../../protocol/messages';
import { kStroke } from '../../parts/icons';
import { planWords } from './live_words';

const words = planWords;

/** Supervisors of the plan and of its active actor; an eye tells whether one watches. */
export function PlanWatchers({ supervisors }: { supervisors: readonly PlanSupervisor[] }) {
  return (
    <section className="planlive__part" aria-label={words.watching}>
      <h3>{words.watching}</h3>
      {supervisors.length === 0 ? <p className="quiet">{words.nobody}</p> : null}
      <ul>
        {supervisors.map(({ name, global, watching, events }) => {
          const Icon = watching ? IconEye : IconEyeClosed;
          return (
            <li key={`${name} ${global}`} className={watching ? 'watcher is-on' : 'watcher'}>
              <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
              <span>{name}</span>
              {global ? <span className="muted">{words.always}</span> : null}
              {watching ? null : <span className="muted">{words.rests}</span>}
              <span className="watcher__events ellipsis">{events.join(', ')}</span>
            </li>
          );
        })}
      </ul>
    </section>
  );
}
