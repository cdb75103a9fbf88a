import { useId, useRef, useState } from 'react';
import { useDrives, useStudio } from '../hooks';
import { Button } from '../parts/button';
import { text } from '../text';

/** Connects to what is typed. */
export function AddressForm({ onDone }: { onDone?: () => void }) {
  const studio = useStudio();
  const drives = useDrives();
  const id = useId();
  const [address, setAddress] = useState('');
  const field = useRef<HTMLInputElement>(null);
  const [isAsked, setAsked] = useState(false);
  const lacks = isAsked && address.trim() === '';
  return (
    <form
      className="address"
      onSubmit={(event) => {
        event.preventDefault();
        if (!address.trim()) {
          setAsked(true);
          return field.current?.focus();
        }
        studio.order('target.choose', { target: address.trim() });
        onDone?.();
      }}
    >
      <label className="address__label" htmlFor={id}>
        {text.target.address}
      </label>
      <input
        ref={field}
        id={id}
        className="field field--empty"
        aria-invalid={lacks}
        aria-describedby={lacks ? `${id}-why` : undefined}
        value={address}
        placeholder={text.start.addressHint}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => setAddress(event.target.value)}
      />
      <Button type="submit" disabled={!drives}>
        {text.target.connect}
      </Button>
      {lacks ? (
        <p className="address__why" id={`${id}-why`} role="alert">
          {text.target.noAddress}
        </p>
      ) : null}
    </form>
  );
}
