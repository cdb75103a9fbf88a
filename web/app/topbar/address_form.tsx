import { useId, useRef, useState } from 'react';
import { useDrives, useSettings, useStudio } from '../hooks';
import { Button } from '../parts/button';
import { text } from '../text';
import { openFleet } from './open_fleet';

const words = text.target;

/** Connects to what is typed: a robot, or a fleet, which has a login. */
export function AddressForm({ onDone }: { onDone?: () => void }) {
  const studio = useStudio();
  const drives = useDrives();
  const kept = useSettings().fleet;
  const id = useId();
  const [typed, setAddress] = useState('');
  const field = useRef<HTMLInputElement>(null);
  const [why, setWhy] = useState('');
  const address = typed.trim();
  const isFleet = /^mqtts?:/i.test(address);
  const [files, setFiles] = useState<{ ca?: string; login?: string }>({});
  const known = kept?.target === address ? kept : null;
  const fileOf = (name: 'ca' | 'login') => files[name] ?? known?.[name] ?? '';
  const connect = async () => {
    if (!address) {
      setWhy(words.noAddress);
      return field.current?.focus();
    }
    if (!isFleet) studio.order('target.choose', { target: address });
    const problem = isFleet
      ? await openFleet(studio, { target: address, ca: fileOf('ca'), login: fileOf('login') })
      : '';
    setWhy(problem);
    if (problem === '') onDone?.();
  };
  return (
    <form
      className="address"
      onSubmit={(event) => {
        event.preventDefault();
        void connect();
      }}
    >
      <label className="address__label" htmlFor={id}>
        {words.address}
      </label>
      <input
        ref={field}
        id={id}
        className="field field--empty"
        aria-invalid={why !== ''}
        aria-describedby={why !== '' ? `${id}-why` : undefined}
        value={typed}
        placeholder={text.start.addressHint}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => (setWhy(''), setAddress(event.target.value))}
      />
      <Button type="submit" disabled={!drives}>
        {words.connect}
      </Button>
      {isFleet
        ? (['ca', 'login'] as const).map((name) => (
            <label key={name} className="address__file">
              <span className="address__label">{words[name]}</span>
              <input
                className="field field--empty"
                value={fileOf(name)}
                placeholder={words.fileHint}
                spellCheck={false}
                autoComplete="off"
                onChange={(event) => setFiles({ ...files, [name]: event.target.value })}
              />
            </label>
          ))
        : null}
      {why !== '' ? (
        <p className="address__why" id={`${id}-why`} role="alert">
          {why}
        </p>
      ) : null}
    </form>
  );
}
