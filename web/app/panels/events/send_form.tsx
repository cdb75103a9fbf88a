import { useState } from 'react';
import type { Definition } from '../../../protocol/messages';
import { readWords } from '../../../core/numbers';
import { toast, updateEvents } from '../../../core/window_state';
import { useStudio, useTopic } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Quiet } from '../../parts/blank';
import { Button } from '../../parts/button';
import { text } from '../../text';
import { eventWords } from './words';

const words = eventWords;
/** With more arguments they are typed into one field. */
const kFieldsMax = 6;

/** Sends an event of the project; stays open with what was typed, so that it can be sent again. */
export function SendForm() {
  const studio = useStudio();
  const events = (useTopic('scripts', {})?.files ?? []).flatMap((file) => file.events);
  const [name, setName] = useState('');
  const [typed, setTyped] = useState<Record<string, string[]>>({});
  const event = events.find((one) => one.name === name) ?? events[0];
  const close = () => updateEvents(studio.window, { send: false });
  if (!event) return <Quiet>{words.none}</Quiet>;
  const fields = typed[event.name] ?? [];
  const args = argumentsOf(event, fields);
  const send = async () => {
    if (!args) return;
    await studio.send('event.send', { name: event.name, args });
    toast(studio.window, 'ok', words.sent(event.name));
  };
  return (
    <form
      className="send"
      aria-label={words.send}
      onSubmit={(submit) => {
        submit.preventDefault();
        send().catch((problem: unknown) => studio.tell(problem));
      }}
      onKeyDown={(key) => key.key === 'Escape' && close()}
    >
      <select
        className="field field--small"
        autoFocus
        aria-label={words.event}
        value={event.name}
        onChange={(change) => setName(change.target.value)}
      >
        {events.map((one) => (
          <option key={one.name}>{one.name}</option>
        ))}
      </select>
      <Arguments
        event={event}
        fields={fields}
        onChange={(next) => setTyped({ ...typed, [event.name]: next })}
      />
      <SendButton good={args !== null} />
    </form>
  );
}

function SendButton({ good }: { good: boolean }) {
  const drives = useMayAct();
  const robot = useTopic('robot', {});
  const there = robot !== undefined && robot.kind !== 'none';
  return (
    <Button
      small
      type="submit"
      disabled={!drives || !there || !good}
      title={there ? undefined : words.noRobot}
    >
      {words.sendButton}
    </Button>
  );
}

function Arguments({
  event,
  fields,
  onChange,
}: {
  event: Definition;
  fields: readonly string[];
  onChange(fields: string[]): void;
}) {
  const count = event.value > kFieldsMax ? 1 : event.value;
  return Array.from({ length: count }, (_, index) => {
    const value = fields[index] ?? (event.value > kFieldsMax ? '' : '0');
    const good = readWords(value) !== null && (event.value > kFieldsMax || value.trim() !== '');
    const label = event.value > kFieldsMax ? words.arguments : words.argument(index);
    return (
      <input
        key={index}
        className={`field field--small num send__field${event.value > kFieldsMax ? ' send__field--all' : ''}`}
        aria-label={label}
        title={good ? label : text.variables.badValue}
        placeholder={event.value > kFieldsMax ? words.arguments : undefined}
        aria-invalid={!good}
        value={value}
        onFocus={(focus) => focus.target.select()}
        onChange={(change) => {
          const next = Array.from({ length: count }, (_one, at) => fields[at] ?? '0');
          next[index] = change.target.value;
          onChange(next);
        }}
      />
    );
  });
}

/** null if something that is typed is no word. What is missing is 0. */
function argumentsOf({ value }: Definition, fields: readonly string[]): number[] | null {
  const count = value > kFieldsMax ? 1 : value;
  const parts = Array.from({ length: count }, (_, index) =>
    readWords(fields[index] ?? (value > kFieldsMax ? '' : '0')),
  );
  const words = parts.flatMap((part) => part ?? []);
  if (parts.some((part) => part === null) || words.length > value) return null;
  return [...words, ...new Array<number>(value - words.length).fill(0)];
}
