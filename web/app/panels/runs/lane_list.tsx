import { shownTime } from '../../../core/numbers';
import { pairingOf, type Compared } from '../../../core/pairing';
import type { ComparedLane } from '../../../protocol/messages';
import { useStudio } from '../../hooks';
import { stepThroughRows } from '../../parts/list_keys';
import { laneWords, recordedWords } from './difference_words';
import { lookAtBoth } from './look_at_both';
import { runWords as words } from './words';

/** Where each lane differs first: a click goes there in both; and what the two were started with. */
export function LaneList({ found }: { found: Compared }) {
  const differ = found.lanes.filter(({ t }) => t !== undefined);
  const same = found.lanes.filter(({ t }) => t === undefined).map(({ name }) => laneWords(name));
  return (
    <div className="runs__lanes scroll">
      {differ.length > 0 ? (
        <ol className="runs__list" aria-label={words.lanes} onKeyDown={stepThroughRows}>
          {differ.map((lane) => (
            <li key={lane.name}>
              <Row lane={lane} found={found} />
            </li>
          ))}
        </ol>
      ) : null}
      {same.length > 0 ? (
        <p className="runs__note">
          {words.none} {same.join(', ')}
        </p>
      ) : null}
      {found.started.length > 0 ? <Started found={found} /> : null}
    </div>
  );
}

function Row({ lane, found }: { lane: ComparedLane; found: Compared }) {
  const studio = useStudio();
  const { name, t = 0, place, a, b } = lane;
  const [inA, inB] = [shownTime(found.a.start + t), shownTime(found.b.start + t)];
  const isOn = Math.abs(pairingOf(studio).t - t) < 5e-4;
  return (
    <button
      type="button"
      data-inset
      className={isOn ? 'runs__lane is-on' : 'runs__lane'}
      onClick={() => lookAtBoth(studio, t)}
    >
      <span className="runs__name">{laneWords(name, place)}</span>
      <time className="num">{inA === inB ? words.at(inA) : words.atBoth(inA, inB)}</time>
      <Value side="A" text={a && recordedWords(name, a)} />
      <Value side="B" text={b && recordedWords(name, b)} />
    </button>
  );
}

function Value({ side, text }: { side: string; text: string | undefined }) {
  return (
    <span className="runs__value">
      <b>{side}</b>{' '}
      {text ? (
        <code className="ellipsis" title={text}>
          {text}
        </code>
      ) : (
        <span className="muted">{words.nothing}</span>
      )}
    </span>
  );
}

function Started({ found }: { found: Compared }) {
  return (
    <ul className="runs__started">
      {found.started.map(({ what, a, b }) => (
        <li key={what}>
          {words.started} {what}
          <Value side="A" text={a && recordedWords(what, a)} />
          <Value side="B" text={b && recordedWords(what, b)} />
        </li>
      ))}
    </ul>
  );
}
