import {
  IconAlertOctagon,
  IconAlertTriangle,
  IconCircleCheck,
  IconHistory,
  IconPlayerPause,
} from '@tabler/icons-react';
import { countsOf } from '../../core/findings';
import { shownTime } from '../../core/numbers';
import { pausedLineOf } from '../../core/run_state';
import {
  useFleetShown,
  useIsGone,
  usePart,
  useStudio,
  useTopic,
  useUnsent,
  useWindow,
} from '../hooks';
import { kStroke } from '../parts/icons';
import { timeOf } from '../parts/time_of';
import { useEnd, usePastTime } from '../past_hooks';
import { text } from '../text';
import { FleetHints, Hints } from './hints';

/** What is paused, what is unsaved, what runs; and the keys that help now. */
export function StatusBar() {
  const opened = useTopic('studio', {})?.project;
  const isFleet = useFleetShown();
  const project = isFleet ? undefined : opened;
  return (
    <footer className="status" data-region="status" aria-label={text.regions.status}>
      {project ? <Left /> : <span className="status__part">{text.status.ready}</span>}
      {isFleet ? <FleetHints /> : <Hints started={!!project} />}
    </footer>
  );
}

function Left() {
  const { registry } = useStudio();
  const errors = usePart('findings', {}, (is) => countsOf(is?.findings ?? []).errors);
  const warnings = usePart('findings', {}, (is) => countsOf(is?.findings ?? []).warnings);
  const isUnsent = useUnsent();
  const isGone = useIsGone();
  const unsaved = usePart('files', {}, (is) => is?.files.some((file) => file.unsaved) ?? false);
  const { saved, notSaved, notOnDisk } = text.status;
  const Icon = errors > 0 ? IconAlertOctagon : warnings > 0 ? IconAlertTriangle : IconCircleCheck;
  const found = [
    errors > 0 && text.status.errors(errors),
    warnings > 0 && text.status.warnings(warnings),
  ].filter(Boolean);
  return (
    <>
      <button type="button" className="status__part" onClick={() => registry.run('panel.problems')}>
        <Icon size={13} stroke={kStroke} aria-hidden />
        {found.length > 0 ? found.join(', ') : text.status.noProblems}
      </button>
      <span className="status__part">
        {isUnsent ? notSaved : isGone ? notOnDisk : unsaved ? notSaved : saved}
      </span>
      <Runs />
    </>
  );
}

function Runs() {
  const at = usePastTime();
  const end = useEnd();
  const doc = useWindow((state) => state.doc);
  const nodes = useTopic('robot', {})?.nodes ?? [];
  const holds = usePart('plan', {}, (is) => is?.stands_at?.[0]);
  const broken = useTopic('breakpoints', {})?.plans.find((one) => one.number === holds);
  if (at !== null)
    return (
      <span className="status__part">
        <IconHistory size={13} stroke={kStroke} aria-hidden />
        {text.status.looksBack(shownTime(at), shownTime(end))}
      </span>
    );
  const standing = nodes.find((node) => pausedLineOf(node) !== undefined);
  if (standing?.at)
    return (
      <span className="status__part">
        <IconPlayerPause size={13} stroke={kStroke} aria-hidden />
        {text.status.pausedAt(standing.name, standing.at.line)}
        <ActiveActor />
      </span>
    );
  if (broken)
    return (
      <span className="status__part">
        <IconPlayerPause size={13} stroke={kStroke} aria-hidden />
        {text.breakpoints.pausedAt(text.breakpoints.place(broken))}
      </span>
    );
  const node = nodes.find((one) => one.doc === doc);
  if (!node?.loaded_wall || node.state !== 'running') return null;
  return (
    <span className="status__part">
      {text.status.runsScript(node.name, timeOf(node.loaded_wall))}
    </span>
  );
}

/** From the line where a node is paused back to the drawing. */
function ActiveActor() {
  const { registry } = useStudio();
  const actor = usePart('plan', {}, (is) =>
    is?.state === 'running' || is?.state === 'paused'
      ? is.levels.findLast((level) => level.actor !== '')?.actor
      : undefined,
  );
  if (actor === undefined) return null;
  return (
    <button type="button" className="status__actor" onClick={() => registry.run('plan.show')}>
      {text.status.showActor(actor)}
    </button>
  );
}
