import { Menu } from '@mantine/core';
import {
  IconChevronDown,
  IconHistory,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerStopFilled,
} from '@tabler/icons-react';
import type { Topics } from '../../protocol/messages';
import { usePart, useStudio } from '../hooks';
import { endedPlan, hasNotBegun, whatRuns } from '../../core/run_choice';
import { useEnd, useMayAct, usePastTime } from '../past_hooks';
import { shownTime } from '../../core/numbers';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { CommandItem, StudioMenu } from '../parts/menu';
import { text } from '../text';

const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 0];

/** The run's clock, what it does, and its speed. */
export function Clock() {
  const studio = useStudio();
  const drives = useMayAct();
  const past = usePastTime();
  const end = useEnd();
  // In parts: a paused clock comes ten times a second, too, with another time of the wall.
  const state = usePart('clock', {}, (is) => is?.state ?? 'none');
  const t = usePart('clock', {}, (is) => is?.t ?? 0);
  const speed = usePart('clock', {}, (is) => is?.speed ?? 1);
  const real = usePart('clock', {}, (is) => is?.real ?? 1);
  const why = usePart('clock', {}, (is) => is?.why);
  const nodes = usePart('robot', {}, (is) => whatRuns(is, undefined));
  const plan = usePart('plan', {}, (is) => whatRuns(undefined, is));
  const ended = usePart('plan', {}, (is) => {
    const last = endedPlan(is);
    return last ? text.run.planEnded[last.result](last.name) : '';
  });
  const isBus = usePart('robot', {}, (is) => is?.kind === 'bus');
  // On a bus there is a clock only while a plan runs.
  if (isBus && state === 'none') return <RunsAlone names={nodes} />;
  const said = stateText({ state, t, plan, nodes, ended });
  const Icon =
    past !== null
      ? IconHistory
      : state === 'running'
        ? IconPlayerPlayFilled
        : state === 'none' || state === 'ended'
          ? IconPlayerStopFilled
          : IconPlayerPauseFilled;
  const button = (
    <button
      type="button"
      className={`clock clock--${past === null ? state : 'past'}`}
      title={why ?? said}
    >
      <Icon className="icon" size={14} aria-hidden />
      <span className="clock__time">
        {past === null ? t.toFixed(state === 'paused' ? 3 : 1) : shownTime(past)} s
      </span>
      <span className="clock__state">
        {past === null ? said : text.past.agoShort((end - past).toFixed(1))}
      </span>
      <span className="clock__line" />
      <span className="hidden-text">{text.menu.speed}</span>
      <span className="clock__speed num">{text.run.speed(speed)}</span>
      <IconChevronDown className="icon" size={12} stroke={kStroke} aria-hidden />
    </button>
  );
  // A run that hangs is ended here: nothing in the menu would be answered.
  if (state === 'hanging')
    return (
      <div className="runbar">
        <span className="clock clock--hanging">
          <Icon className="icon" size={14} aria-hidden />
          <span className="clock__state">{text.run[state]}</span>
        </span>
        <Button
          className="is-stop"
          disabled={!drives}
          title={text.run.hangs}
          onClick={() => void studio.registry.run('run.end')}
        >
          {text.run.end}
        </Button>
      </div>
    );
  return (
    <StudioMenu button={button}>
      {drives ? null : (
        <Menu.Label>{past === null ? text.whyNot.viewOnly : text.whyNot.looksBack}</Menu.Label>
      )}
      <Menu.Label>
        {text.menu.speed} · {text.run.measured(real)}
      </Menu.Label>
      {speeds.map((one) => (
        <Menu.Item
          key={one}
          disabled={!drives}
          onClick={() => studio.order('clock.speed', { speed: one })}
          aria-current={one === speed}
        >
          {one === 0 ? text.run.asFast : text.run.speed(one)}
          {one === speed ? ' ✓' : ''}
        </Menu.Item>
      ))}
      <Menu.Divider />
      <CommandItem id="run.reset" title={text.run.reset} />
      <CommandItem id="run.end" />
    </StudioMenu>
  );
}

/** Scripts of ours that run on a robot, without a plan. */
function RunsAlone({ names }: { names: string }) {
  if (names === '') return null;
  return (
    <span className="clock clock--running" title={names}>
      <IconPlayerPlayFilled className="icon" size={14} aria-hidden />
      <span className="clock__state">{`${text.run.running}: ${names}`}</span>
    </span>
  );
}

interface Shown {
  state: Topics['clock']['is']['state'];
  t: number;
  /** What runs, by name. */
  plan: string;
  nodes: string;
  /** How the plan before ended. */
  ended: string;
}

/** "Running: WallFollow", "WallFollow finished, scripts run"; a world alone says so, too. */
function stateText({ state, t, plan, nodes, ended }: Shown): string {
  if (hasNotBegun({ state, t })) return text.run.ready;
  if (state !== 'running') return text.run[state];
  if (ended) return nodes ? `${ended}, ${text.run.scriptsRun}` : ended;
  return `${text.run.running}: ${plan || nodes || text.run.worldOnly}`;
}
