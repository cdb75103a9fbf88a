import { useEffect, useRef } from 'react';
import type { Colour } from '../../../protocol/messages';
import { tidy } from '../../../core/world/snap';
import { Field } from './fields';

/** Told once, when the colour is chosen, not at each one on the way. */
export function ColourField(props: {
  label: string;
  value: Colour;
  disabled?: boolean;
  onSet: (value: Colour) => void;
}) {
  const { label, value, disabled, onSet } = props;
  const input = useRef<HTMLInputElement>(null);
  const hex = hexOf(value);
  useEffect(() => {
    const place = input.current;
    if (!place) return;
    place.value = hex;
    const chosen = () => {
      if (place.value !== hex) onSet(colourOfHex(place.value));
    };
    place.addEventListener('change', chosen);
    return () => place.removeEventListener('change', chosen);
  }, [hex, onSet]);
  return (
    <Field label={label}>
      {(id) => (
        <>
          <input
            id={id}
            ref={input}
            type="color"
            className="colour"
            defaultValue={hex}
            disabled={disabled}
          />
          <code className="muted">{value.map((part) => tidy(part)).join(' ')}</code>
        </>
      )}
    </Field>
  );
}

function hexOf(colour: Colour): string {
  return `#${colour
    .map((part) =>
      Math.round(Math.min(1, Math.max(0, part)) * 255)
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;
}

function colourOfHex(hex: string): Colour {
  return [1, 3, 5].map(
    (at) => Math.round((parseInt(hex.slice(at, at + 2), 16) / 255) * 1000) / 1000,
  );
}
