import { pairingOf } from '../../../core/pairing';
import { shownTime } from '../../../core/numbers';
import { useChanges, useStudio } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { PairForm } from './pair_form';
import { LaneList } from './lane_list';
import { PairInstant } from './pair_instant';
import { PairTracks } from './pair_tracks';
import { PairWorld } from './pair_world';
import { runWords as words } from './words';
import '../../look/runs.css';

/** Two recorded runs side by side: where they differ first, and both as they were at one instant. */
export default function RunsPanel() {
  const pairing = pairingOf(useStudio());
  useChanges(pairing.changed);
  const { found, asked, trouble, waits, t } = pairing;
  return (
    <div className="runs">
      <PairForm />
      {trouble ? (
        <p className="runs__note is-error" role="alert">
          {trouble}
        </p>
      ) : null}
      {waits ? (
        <p className="runs__note" role="status">
          {words.waits}
        </p>
      ) : null}
      {!asked ? <Quiet>{words.how}</Quiet> : null}
      {found && asked ? (
        <>
          <p className="runs__note" role="status">
            {sentenceOf(found.lanes)}
          </p>
          <div className="runs__side">
            <PairInstant found={found} t={t} asked={asked} />
            <PairTracks found={found} t={t} />
          </div>
          <div className="runs__both">
            <LaneList found={found} />
            <PairWorld found={found} t={t} />
          </div>
        </>
      ) : null}
    </div>
  );
}

function sentenceOf(lanes: readonly { t?: number }[]): string {
  const differ = lanes.filter(({ t }) => t !== undefined);
  const first = differ[0]?.t;
  return first === undefined ? words.same : words.differs(differ.length, shownTime(first));
}
