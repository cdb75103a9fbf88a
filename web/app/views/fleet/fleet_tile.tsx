import { IconAlertTriangle, IconExternalLink } from '@tabler/icons-react';
import { memo } from 'react';
import { doingOf, type Doing } from '../../../core/fleet';
import type { FleetRobot } from '../../../protocol/messages';
import { usePart } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { DoingSign } from './doing_sign';
import { Since } from './since';
import { words } from './words';

interface TileProps {
  name: string;
  isChosen: boolean;
  /** The keyboard comes here first. */
  isAt: boolean;
  isConnected: boolean;
}

/** One robot. It is drawn again when what it told is another thing, and for nothing else. */
export const FleetTile = memo(function FleetTile(props: TileProps) {
  const { name, isChosen, isAt, isConnected } = props;
  const robot = usePart('fleet', {}, (is) => is?.robots[name]);
  if (!robot) return null;
  const doing = doingOf(robot, isConnected);
  const isOld = !isConnected || doing === 'stuck' || doing === 'lost' || doing === 'offline';
  return (
    <div
      role="option"
      data-robot={name}
      aria-selected={isChosen}
      tabIndex={isAt ? 0 : -1}
      className={`ftile ftile--${doing}${isOld ? ' is-old' : ''}`}
    >
      <div className="ftile__head">
        <span className="ftile__check" data-act="toggle" data-tip={words.choose} aria-hidden>
          <svg viewBox="0 0 12 12">{isChosen ? <path d="M2.5 6.5L5 9L9.5 3.5" /> : null}</svg>
        </span>
        <b
          className="ftile__name ellipsis"
          data-act={robot.studio ? 'open' : undefined}
          title={name}
        >
          {name}
        </b>
        {robot.studio ? (
          <span className="ftile__open" data-act="open" data-tip={`${words.open}  (Enter)`}>
            <IconExternalLink size={14} stroke={kStroke} aria-hidden />
          </span>
        ) : null}
      </div>
      <div className="ftile__doing">
        <DoingSign doing={doing} />
        <span data-tip={words.doingHelp[doing]}>{words.doing[doing]}</span>
        <span className="ftile__since num">
          <When robot={robot} doing={doing} />
        </span>
      </div>
      <code className="ftile__actor ellipsis" title={robot.actor}>
        {robot.actor ?? ''}
      </code>
      <Trouble robot={robot} />
      <div className="ftile__foot ellipsis">{footOf(robot)}</div>
    </div>
  );
});

/** How long it has done that; of one that is silent, since when it is. */
function When({ robot, doing }: { robot: FleetRobot; doing: Doing }) {
  if (robot.told_wall !== undefined)
    return <Since wall={robot.told_wall} words={words.silentFor} />;
  if (robot.since_wall === undefined || doing === 'offline' || doing === 'lost') return null;
  return <Since wall={robot.since_wall} words={words.since} />;
}

function Trouble({ robot }: { robot: FleetRobot }) {
  const problems = robot.problems ?? [];
  const [first] = problems;
  if (first === undefined) return null;
  return (
    <div className="ftile__trouble" data-tip={problems.join('\n')}>
      <IconAlertTriangle className="icon" size={13} stroke={kStroke} aria-hidden />
      <span className="ellipsis">{first}</span>
      {problems.length > 1 ? <span className="count">{problems.length}</span> : null}
    </div>
  );
}

function footOf({ project, vagus, groups }: FleetRobot): string {
  return [project, ...(groups ?? []), vagus ? words.vagus(vagus) : ''].filter(Boolean).join(' · ');
}
