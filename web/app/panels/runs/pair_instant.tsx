import { shownTime } from '../../../core/numbers';
import { spanOf, type Compared, type PairWish } from '../../../core/pairing';
import { useDrives, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { lookAtBoth, showOne } from './look_at_both';
import { runWords as words } from './words';

/** The instant that is shown of both, by a slider; and each of them there in the whole window. */
export function PairInstant(props: { found: Compared; t: number; asked: PairWish }) {
  const { found, t, asked } = props;
  const studio = useStudio();
  const drives = useDrives();
  const { from, to } = spanOf(found);
  const sides = [
    ['A', found.a, asked.a],
    ['B', found.b, asked.b],
  ] as const;
  return (
    <div className="runs__instant">
      <input
        type="range"
        className="runs__slider"
        aria-label={words.cursor}
        aria-valuetext={words.seconds(shownTime(t))}
        min={from}
        max={to}
        step={0.02}
        value={t}
        onChange={(event) => lookAtBoth(studio, Number(event.target.value))}
      />
      <span className="num">{words.at(shownTime(t))}</span>
      {sides.map(([side, run, path]) => (
        <Button
          key={side}
          small
          kind="plain"
          data-tip={words.openHelp(side)}
          disabled={path !== null && !drives}
          onClick={() => void showOne(studio, path, run.start + t)}
        >
          {words.open(side)}
        </Button>
      ))}
      {sides.map(([side, { complete }]) =>
        complete ? null : (
          <p key={side} className="runs__note">
            {words.cut(side)}
          </p>
        ),
      )}
    </div>
  );
}
