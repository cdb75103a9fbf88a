import { IconAlertTriangle, IconEye, IconHistory, IconPlugConnectedX } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import type { Topics } from '../../protocol/messages';
import { useLink, useStudio, useTopic, usePart } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { EndNotice } from './end_notice';
import { Notice } from './notice';
import { PastNotice } from './past_notice';
import { RunNotice } from './run_notice';

/** A line under the top bar when something stands between the person and the robot. */
export function Notices() {
  return (
    <div className="notices">
      <PastNotice />
      <EndNotice />
      <LinkNotice />
      <RunNotice />
      <RobotNotice />
      <DriverNotice />
      <RecoveredNotice />
    </div>
  );
}

function LinkNotice() {
  const link = useLink();
  const silentSince = link.state === 'open' ? link.silentSince : undefined;
  const seconds = useSecondsSince(link.state === 'lost' ? link.since : (silentSince ?? null));
  const icon = <IconPlugConnectedX className="icon" size={14} stroke={kStroke} aria-hidden />;
  if (link.state === 'lost') return <Notice icon={icon}>{text.link.lost(seconds)}</Notice>;
  if (silentSince !== undefined) return <Notice icon={icon}>{text.link.silent(seconds)}</Notice>;
  if (link.state !== 'refused') return null;
  return (
    <Notice icon={icon} error>
      {text.link.refused} {link.problem.what} {text.link.refusedHelp}
    </Notice>
  );
}

function RobotNotice() {
  const robot = useTopic('robot', {});
  const runDied = usePart('clock', {}, (is) => is?.state === 'dead');
  const seconds = useSecondsSince(robot?.state === 'lost' ? (robot.since_wall ?? null) : null);
  const icon = <IconAlertTriangle className="icon" size={14} stroke={kStroke} aria-hidden />;
  // A simulated robot went with its run, which says why.
  if (robot?.kind === 'simulator' && runDied) return null;
  if (robot?.state === 'lost') return <Notice icon={icon}>{text.target.lost(seconds)}</Notice>;
  if (robot?.state !== 'failed') return null;
  return (
    <Notice icon={icon} error>
      {robot.why ?? `${robot.name}: ${text.target.failed}`}
    </Notice>
  );
}

function DriverNotice() {
  const studio = useStudio();
  const state = useTopic('studio', {});
  const link = useLink();
  const request = useRequest(state, link.state === 'open' ? link.number : null);
  const icon = <IconEye className="icon" size={14} stroke={kStroke} aria-hidden />;
  if (link.state !== 'open' || !state) return null;
  if (state.driver !== link.number) {
    const may = link.role === 'drive';
    const end = may ? (
      <Button
        small
        disabled={request === 'waits'}
        onClick={() => void studio.registry.run('driver.ask')}
      >
        {text.driver.ask}
      </Button>
    ) : null;
    return (
      <Notice icon={icon} end={end}>
        {state.driver === 0 ? text.driver.nobody : text.driver[request](state.driver_name)}
      </Notice>
    );
  }
  if (!state.asked) return null;
  const answer = (give: boolean) => () => studio.order('driver.answer', { give });
  const end = (
    <>
      <Button small onClick={answer(true)}>
        {text.driver.give}
      </Button>
      <Button small onClick={answer(false)}>
        {text.driver.keep}
      </Button>
    </>
  );
  return (
    <Notice icon={icon} end={end}>
      {text.driver.asked(state.asked.name)}
    </Notice>
  );
}

/** What became of this page's own request for control, as long as the same page has it. */
function useRequest(
  state: Topics['studio']['is'] | undefined,
  own: number | null,
): 'looks' | 'waits' | 'refused' {
  const waits = own !== null && state?.asked?.client === own;
  const [waited, setWaited] = useState(waits);
  const [refusedBy, setRefusedBy] = useState<number | null>(null);
  if (waited !== waits) {
    setWaited(waits);
    setRefusedBy(waits ? null : (state?.driver ?? null));
  }
  if (waits) return 'waits';
  return refusedBy !== null && refusedBy === state?.driver ? 'refused' : 'looks';
}

/** What was typed before a crash is back; said until it has been seen. */
function RecoveredNotice() {
  const count = useTopic('studio', {})?.recovered.length ?? 0;
  const [seen, setSeen] = useState(0);
  if (count === 0 || seen === count) return null;
  const icon = <IconHistory className="icon" size={14} stroke={kStroke} aria-hidden />;
  const end = (
    <Button small onClick={() => setSeen(count)}>
      {text.seen}
    </Button>
  );
  return (
    <Notice icon={icon} end={end}>
      {text.recovered(count)}
    </Notice>
  );
}

/** Counts while it is shown. */
function useSecondsSince(since: number | null): number {
  const [now, setNow] = useState(() => Date.now());
  useEffect(() => {
    if (since === null) return;
    const timer = setInterval(() => setNow(Date.now()), 1000);
    return () => clearInterval(timer);
  }, [since]);
  return since === null ? 0 : Math.max(0, Math.round((now - since) / 1000));
}
