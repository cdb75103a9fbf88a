import type { Deciding } from '../../../core/deciding';
import { shownTime } from '../../../core/numbers';
import type { Path, Turning } from '../../../protocol/messages';
import { openRecording } from '../../commands/past_commands';
import { useDrives, useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { Chain } from './chain';
import { DecidedCurve } from './decided_curve';
import { DecidedForm } from './decided_form';
import { decidedWords as words, stageWords } from './decided_words';
import '../../look/decided.css';

/** When it was decided that a condition becomes true: asked, looked for, and what was found. */
export default function Decided() {
  const deciding = useTopic('turning', {}) ?? { state: 'none' as const };
  const { state, result } = deciding;
  return (
    <div className="decided scroll">
      <DecidedForm deciding={deciding} />
      {state === 'running' ? <Progress deciding={deciding} /> : null}
      <p className="because__note" role="status">
        {state === 'stopped' ? words.stopped : ''}
        {state === 'none' ? words.how : ''}
      </p>
      {state === 'failed' ? (
        <p className="because__note is-error" role="alert">
          {deciding.why}
        </p>
      ) : null}
      {result ? <Found deciding={deciding} result={result} /> : null}
    </div>
  );
}

function Progress({ deciding }: { deciding: Deciding }) {
  const { stage = 'run', done = 0, of = 0 } = deciding.progress ?? {};
  return (
    <div className="decided__progress">
      <p role="status">{stageWords[stage]}</p>
      {of > 0 ? (
        <>
          <progress className="decided__bar" aria-label={words.progress} max={of} value={done} />
          <span className="num muted">{words.of(done, of)}</span>
        </>
      ) : null}
    </div>
  );
}

function Found({ deciding, result }: { deciding: Deciding; result: Turning }) {
  const studio = useStudio();
  const run = useTopic('history', {})?.run;
  const { came, end, turn, sentence } = result;
  const its = deciding.run === run;
  const look = (t: number) => its && studio.past.look(t);
  return (
    <section className="decided__found" aria-label={words.form}>
      <h3>
        <code>{deciding.condition}</code>
      </h3>
      <p>{came === undefined ? words.never(shownTime(end)) : words.came(shownTime(came))}</p>
      <p className="decided__sentence">{sentence}</p>
      {its ? null : <p className="muted">{words.earlier}</p>}
      <DecidedCurve result={result} onLook={look} />
      {turn ? (
        <>
          <div className="decided__acts">
            <Button small disabled={!its} onClick={() => look(turn.after.t)}>
              {words.look(shownTime(turn.after.t))}
            </Button>
            <OpenOne comes path={turn.with} />
            <OpenOne comes={false} path={turn.without} />
          </div>
          {turn.there.length > 0 ? (
            <>
              <h4>{words.there}</h4>
              <Chain chain={turn.there} />
            </>
          ) : null}
        </>
      ) : null}
    </section>
  );
}

function OpenOne({ comes, path }: { comes: boolean; path: Path | undefined }) {
  const studio = useStudio();
  const drives = useDrives();
  if (path === undefined) return <p className="muted">{words.noOther(comes)}</p>;
  return (
    <Button small kind="plain" disabled={!drives} onClick={() => void openRecording(studio, path)}>
      {comes ? words.with : words.without}
    </Button>
  );
}
