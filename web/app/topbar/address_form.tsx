import { useId, useState } from 'react';
import { useDrives, useStudio } from '../hooks';
import { Button } from '../parts/button';
import { text } from '../text';

/** Connects to what is typed. */
export function AddressForm({ onDone }: { onDone?: () => void }) {
  const studio = useStudio();
  const drives = useDrives();
  const id = useId();
  const [address, setAddress] = useState('');
  return (
    <form
      className="address"
      onSubmit={(event) => {
        event.preventDefault();
        if (!address.trim()) return;
        studio.order('target.choose', { target: address.trim() });
        onDone?.();
      }}
    >
      <label className="address__label" htmlFor={id}>
        {text.target.address}
      </label>
      <input
        id={id}
        className="field field--empty"
        value={address}
        placeholder={text.start.addressHint}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => setAddress(event.target.value)}
      />
      <Button type="submit" disabled={!drives}>
        {text.target.connect}
      </Button>
    </form>
  );
}
