import { namesIn, pairingOf, type Align } from '../../../core/pairing';
import { useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { recordedAt } from '../../parts/recorded_at';
import { useAsked } from '../../use_asked';
import { runWords as words } from './words';

const aligns: readonly Align[] = ['start', 'actor', 'event'];

/** Which two, and where they are laid one over the other. */
export function PairForm() {
  const pairing = pairingOf(useStudio());
  const { wish, found } = pairing;
  const { align } = wish;
  const kind = align === 'start' ? null : align;
  return (
    <form
      className="runs__form"
      aria-label={words.form}
      onSubmit={(event) => (event.preventDefault(), void pairing.ask())}
    >
      <RunChoice side="a" />
      <RunChoice side="b" />
      <label>
        {words.align}
        <select
          className="field field--small field--ui"
          value={align}
          onChange={(event) =>
            pairing.choose({ align: aligns.find((one) => one === event.target.value) ?? 'start' })
          }
        >
          {aligns.map((one) => (
            <option key={one} value={one}>
              {words.aligns[one]}
            </option>
          ))}
        </select>
      </label>
      {kind ? (
        <input
          className="field field--small"
          aria-label={words.name[kind]}
          placeholder={words.name[kind]}
          list="runs-names"
          spellCheck={false}
          autoComplete="off"
          value={wish.name}
          onChange={(event) => pairing.choose({ name: event.target.value })}
        />
      ) : null}
      <datalist id="runs-names">
        {namesIn(found, align).map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      <Button small type="submit" disabled={wish.a === wish.b}>
        {words.compare}
      </Button>
    </form>
  );
}

/** The run that is shown, one before it, or a recording of the project. */
function RunChoice({ side }: { side: 'a' | 'b' }) {
  const pairing = pairingOf(useStudio());
  const chosen = pairing.wish[side];
  const run = useTopic('history', {})?.run;
  const answer = useAsked('recording.list', {}, run);
  const kept = answer === null || answer === 'refused' ? [] : answer.recordings;
  const files = (useTopic('files', {})?.files ?? [])
    .map(({ path }) => path)
    .filter((path) => path.endsWith('.mcap'));
  const paths = [...kept.map(({ path }) => path), ...files];
  return (
    <label>
      {side.toUpperCase()}
      <select
        className="field field--small field--ui runs__choice"
        {...(side === 'b' ? { 'data-autofocus': true } : {})}
        value={chosen ?? ''}
        onChange={(event) => pairing.choose({ [side]: event.target.value || null })}
      >
        <option value="">{words.shown}</option>
        {kept.map(({ path, number, when_wall }) => (
          <option key={path} value={path}>
            {words.run(number, recordedAt(when_wall))}
          </option>
        ))}
        {files.map((path) => (
          <option key={path} value={path}>
            {path}
          </option>
        ))}
        {chosen !== null && !paths.includes(chosen) ? (
          <option value={chosen}>{chosen}</option>
        ) : null}
      </select>
    </label>
  );
}
