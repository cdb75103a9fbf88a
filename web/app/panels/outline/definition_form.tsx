import { useState, type ReactNode } from 'react';
import type { Definition, Path } from '../../../protocol/messages';
import { toast } from '../../../core/window_state';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { text } from '../../text';

export type DefinitionKind = 'event' | 'constant';

const words = text.outline;

/** Adds an event or a constant, or changes one. */
export function DefinitionForm({
  file,
  kind,
  definition,
  onEnd,
}: {
  file: Path;
  kind: DefinitionKind;
  definition?: Definition;
  onEnd(): void;
}) {
  const studio = useStudio();
  const [name, setName] = useState(definition?.name ?? '');
  const [value, setValue] = useState(String(definition?.value ?? 0));
  const [least, most] = kind === 'event' ? [0, 258] : [-32768, 32767];
  const good = /^-?\d+$/.test(value) && Number(value) >= least && Number(value) <= most;
  const save = async () => {
    if (!good || name === '') return;
    if (!definition) await studio.change('define.add', { file, kind, name, value: Number(value) });
    else {
      const { places, others } = await studio.change('define.change', {
        file,
        kind,
        name: definition.name,
        to: name,
        value: Number(value),
      });
      if (name !== definition.name) toast(studio.window, 'ok', words.renamed(places, others));
    }
    onEnd();
  };
  return (
    <Inline onEnd={onEnd} onSubmit={save} button={definition ? words.save : words.addButton}>
      <input
        className="field field--small"
        autoFocus
        aria-label={words.name}
        placeholder={words.name}
        value={name}
        spellCheck={false}
        onChange={(event) => setName(event.target.value)}
      />
      <input
        className="field field--small num inline__value"
        aria-label={kind === 'event' ? words.size : words.value}
        title={good ? undefined : kind === 'event' ? words.badSize : words.badNumber}
        aria-invalid={!good}
        value={value}
        onChange={(event) => setValue(event.target.value.trim())}
      />
    </Inline>
  );
}

/** Sends an event with arguments. */
export function SendForm({ definition, onEnd }: { definition: Definition; onEnd(): void }) {
  const studio = useStudio();
  const [values, setValues] = useState(
    Array.from({ length: Math.min(definition.value, 32) }, () => '0').join(' '),
  );
  const args = values
    .split(/[\s,]+/)
    .filter(Boolean)
    .map(Number);
  const good = args.every((value) => Number.isInteger(value) && value >= -32768 && value <= 32767);
  const send = async () => {
    if (!good) return;
    await studio.send('event.send', { name: definition.name, args });
    onEnd();
  };
  return (
    <Inline onEnd={onEnd} onSubmit={send} button={words.sendButton}>
      <code className="ellipsis inline__name">{definition.name}</code>
      <input
        className="field field--small num"
        autoFocus
        aria-label={words.arguments}
        title={good ? words.arguments : words.badNumber}
        aria-invalid={!good}
        value={values}
        onChange={(event) => setValues(event.target.value)}
      />
    </Inline>
  );
}

/** A form in one row of a list. */
function Inline({
  children,
  button,
  onSubmit,
  onEnd,
}: {
  children: ReactNode;
  button: string;
  onSubmit(): Promise<void>;
  onEnd(): void;
}) {
  const studio = useStudio();
  return (
    <form
      className="inline"
      onSubmit={(event) => {
        event.preventDefault();
        onSubmit().catch((problem: unknown) => studio.tell(problem));
      }}
      onKeyDown={(event) => event.key === 'Escape' && (event.stopPropagation(), onEnd())}
      onBlur={(event) => event.currentTarget.contains(event.relatedTarget) || onEnd()}
    >
      {children}
      <Button small type="submit">
        {button}
      </Button>
    </form>
  );
}
