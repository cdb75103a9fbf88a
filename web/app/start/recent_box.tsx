import { IconClock, IconFolder, IconHistory, IconX } from '@tabler/icons-react';
import type { Recent } from '../../protocol/messages';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Blank } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { startWords } from './words';

export function RecentBox() {
  const recent = useTopic('start', {})?.recent ?? [];
  return (
    <section className="box" aria-label={startWords.recent}>
      <div className="first__title">
        <IconHistory className="icon" size={16} stroke={kStroke} aria-hidden />
        <h2>{startWords.recent}</h2>
      </div>
      {recent.length === 0 ? (
        <Blank
          icon={<IconClock className="icon" size={20} stroke={kStroke} aria-hidden />}
          title={startWords.noRecent}
        >
          {startWords.noRecentHelp}
        </Blank>
      ) : (
        <ul className="recent">
          {recent.slice(0, 10).map((one) => (
            <RecentRow key={one.path} recent={one} />
          ))}
        </ul>
      )}
    </section>
  );
}

function RecentRow({ recent }: { recent: Recent }) {
  const studio = useStudio();
  const drives = useDrives();
  const { path, name, there } = recent;
  return (
    <li className="recent__row">
      <button
        type="button"
        className="recent__open"
        disabled={!drives || !there}
        onClick={() => studio.order('project.open', { path })}
      >
        <IconFolder className="icon" size={16} stroke={kStroke} aria-hidden />
        <span>
          <b>{name}</b>
          <span className="box__help ellipsis">{there ? path : startWords.gone}</span>
        </span>
      </button>
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={startWords.forget(name)}
        icon={<IconX size={14} stroke={kStroke} />}
        onClick={() => studio.order('project.forget', { path })}
      />
    </li>
  );
}
