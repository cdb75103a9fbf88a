import { IconAlertTriangle, IconCircleCheck, IconX } from '@tabler/icons-react';
import { sortedOutcomes } from '../../../core/fleet';
import type { Report } from '../../../core/fleet_desk';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { useFleetDesk } from './use_fleet';
import { words } from './words';

const said = words.report;

/** What became of the last order of this page: who did not do it is named. */
export function FleetReport() {
  const desk = useFleetDesk();
  const { report } = desk;
  if (!report) return null;
  const missing = missingIn(report);
  const isGood = report.is === 'sent' || (report.is === 'answered' && missing.length === 0);
  const Icon = isGood ? IconCircleCheck : IconAlertTriangle;
  return (
    <div
      className={isGood ? 'notice notice--plain' : 'notice notice--error'}
      role={isGood ? 'status' : 'alert'}
    >
      <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
      <span className="freport">{sentence(report)}</span>
      <span className="grow" />
      {missing.length > 0 ? (
        <Button
          small
          onClick={() =>
            desk.set({
              query: '',
              choice: { ...desk.choice, chosen: new Set(missing), at: missing[0] ?? null },
            })
          }
        >
          {said.chooseThese}
        </Button>
      ) : null}
      {report.is === 'sent' ? null : (
        <Button
          kind="plain"
          small
          tip={said.dismiss}
          icon={<IconX size={14} stroke={kStroke} />}
          onClick={() => desk.set({ report: null })}
        />
      )}
    </div>
  );
}

function missingIn(report: Report): string[] {
  if (report.is !== 'answered') return [];
  return report.outcomes.filter(({ result }) => result !== 'done').map(({ robot }) => robot);
}

function sentence(report: Report): string {
  const what = words.verbs[report.verb];
  if (report.is === 'sent') return said.sent(what, report.robots);
  if (report.is === 'failed') return said.failed(what, report.why);
  if (report.outcomes.length === 0) return said.nobody(what);
  const { done, refused, silent, away } = sortedOutcomes(report.outcomes);
  const names = (list: typeof done) => list.map(({ robot }) => robot);
  return [
    said.done(what, done.length, report.outcomes.length),
    silent.length > 0 ? said.silent(names(silent)) : '',
    away.length > 0 ? said.away(names(away)) : '',
    ...refused.slice(0, 5).map(({ robot, what: why }) => said.refused(robot, why)),
  ]
    .filter(Boolean)
    .join(' ');
}
