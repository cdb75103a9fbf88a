import { IconX } from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import { mistakeInList } from '../../../core/condition';
import { logsOf, type LogPlace, type LogPoint } from '../../../core/logs';
import { nameOf } from '../../documents';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { PointNotes } from './point_notes';
import { revealPlace } from './reveal_place';
import { logWords as words, placeName, stateOf } from './words';

/** One log point: where, what it shows, and how its question stands. */
export function PointRow({ point, onDown }: { point: LogPoint; onDown(): void }) {
  const studio = useStudio();
  const logs = logsOf(studio);
  const { number, place, state } = point;
  const [typed, setTyped] = useState(point.values);
  const [wrong, setWrong] = useState('');
  const name = placeName(place, (doc) => nameOf(studio, doc));
  const ask = () => {
    const values = typed.trim();
    const mistake = values === '' ? words.needsValues : mistakeInList(values);
    setWrong(mistake);
    if (mistake === '') logs.ask(number, values);
  };
  const pressed = (event: KeyboardEvent) => {
    if (event.key !== 'ArrowDown') return;
    event.preventDefault();
    onDown();
  };
  const isSame = typed.trim() === point.values;
  const trouble = wrong || (isSame ? point.trouble : '');
  return (
    <li className="logs__point">
      <form className="logs__form" noValidate onSubmit={(event) => (event.preventDefault(), ask())}>
        <span className="logs__mark" aria-hidden />
        <button
          type="button"
          className="logs__place ellipsis"
          onClick={() => revealPlace(studio, place)}
        >
          {place.is === 'line' ? <code>{name}</code> : place.element}
        </button>
        <WhenOf place={place} onMove={(when) => logs.move(number, when)} />
        <input
          className="field field--small grow"
          aria-label={words.values(name)}
          placeholder={place.is === 'line' ? words.hintOfScript : words.hintOfPlan}
          value={typed}
          aria-invalid={trouble !== ''}
          spellCheck={false}
          autoComplete="off"
          {...(number === logs.wanted ? { 'data-autofocus': true } : {})}
          onChange={(event) => (setTyped(event.target.value), setWrong(''))}
          onKeyDown={pressed}
        />
        <span className="logs__state muted num">{stateOf(point, logs.asking === number)}</span>
        {state === 'waits' ? (
          <Button small onClick={() => logs.cancel(number)}>
            {words.cancel}
          </Button>
        ) : (
          <Button small type="submit">
            {state === 'typed' || !isSame ? words.ask : words.again}
          </Button>
        )}
        <Button
          kind="plain"
          small
          tip={words.remove(name)}
          icon={<IconX size={14} stroke={kStroke} />}
          onClick={() => logs.remove(number)}
        />
      </form>
      <PointNotes point={point} trouble={trouble} />
    </li>
  );
}

/** Of an actor: when it begins or when it ends. */
function WhenOf({ place, onMove }: { place: LogPlace; onMove(when: 'enter' | 'leave'): void }) {
  if (place.is === 'line') return null;
  if (place.is === 'supervisor') return <span className="muted">{words.raise}</span>;
  return (
    <select
      className="field field--small field--ui"
      aria-label={words.when(place.element)}
      value={place.when}
      onChange={(event) => onMove(event.target.value === 'leave' ? 'leave' : 'enter')}
    >
      <option value="enter">{words.enter}</option>
      <option value="leave">{words.leave}</option>
    </select>
  );
}
