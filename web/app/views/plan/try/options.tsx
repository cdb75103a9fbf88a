import { IconBolt } from '@tabler/icons-react';
import type { Option, Trying } from '../../../../core/plan/trying';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { tryWords as words } from './words';

/** The states in which the active actor can end, and the events that can be raised. */
export function Options({ trying }: { trying: Trying }) {
  const numbered = trying.options.map((option, at) => ({ option, number: at + 1 }));
  const of = (is: Option['is']) => numbered.filter(({ option }) => option.is === is);
  const [states, events] = [of('state'), of('event')];
  if (numbered.length === 0) return null;
  return (
    <div className="ptry__options">
      {states.length === 0 ? null : (
        <div role="group" aria-label={words.states(states[0]?.option.element ?? '')}>
          {states.map((one) => (
            <Choice key={one.number} trying={trying} {...one} />
          ))}
        </div>
      )}
      {states.length === 0 ? null : <Outputs trying={trying} />}
      {events.length === 0 ? null : (
        <>
          <span className="muted">{words.raises}</span>
          <div role="group" aria-label={words.events}>
            {events.map((one) => (
              <Choice key={one.number} trying={trying} {...one} />
            ))}
          </div>
        </>
      )}
    </div>
  );
}

/** What the active actor gives when it ends: nothing where a field is empty. */
function Outputs({ trying }: { trying: Trying }) {
  const { outputs, typed } = trying;
  if (outputs.length === 0) return null;
  return (
    <div role="group" aria-label={words.outputs}>
      <span className="muted">{words.gives}</span>
      {outputs.map((one) => (
        <label key={one.name} className="ptry__output">
          {one.name}
          <input
            className="field field--small"
            autoComplete="off"
            spellCheck={false}
            value={typed[one.name] ?? ''}
            placeholder={words.kept}
            aria-invalid={trying.isWrong(one)}
            title={trying.isWrong(one) ? words.wrong(one.name, one.type ?? '') : words.outputHelp}
            size={8}
            onChange={({ target }) => trying.type(one, target.value)}
          />
        </label>
      ))}
    </div>
  );
}

function Choice(props: { trying: Trying; option: Option; number: number }) {
  const { trying, option, number } = props;
  const isEvent = option.is === 'event';
  return (
    <Button
      small
      data-option={number}
      {...(number < 10 ? { keys: String(number) } : {})}
      icon={isEvent ? <IconBolt size={14} stroke={kStroke} aria-hidden /> : null}
      onClick={() => void trying.choose(option)}
    >
      {isEvent ? words.event(option.element, option.outcome) : option.outcome}
    </Button>
  );
}
