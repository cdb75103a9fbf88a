// Keys: how a combination is written, shown and recognised.

export interface KeyPress {
  key: string;
  code: string;
  ctrlKey: boolean;
  shiftKey: boolean;
  altKey: boolean;
  metaKey: boolean;
}

/** "Ctrl+Shift+F" in one spelling, so that two spellings of one key are seen to clash. */
export function normalKey(text: string): string {
  const parts = text === '+' ? ['+'] : text.split('+');
  const key = parts.pop() ?? '';
  const has = (name: string) => parts.some((part) => part.toLowerCase() === name);
  return spell(has('ctrl'), has('alt'), has('shift'), key.length === 1 ? key.toUpperCase() : key);
}

/** The spellings by which a press can be meant; "?" is met with or without Shift. */
export function pressedKeys(press: KeyPress): string[] {
  const control = press.ctrlKey || press.metaKey;
  const letter =
    press.key === ' ' ? 'Space' : press.key.length === 1 ? press.key.toUpperCase() : press.key;
  const found = [spell(control, press.altKey, press.shiftKey, letter)];
  if (press.shiftKey && letter.length === 1)
    found.push(spell(control, press.altKey, false, letter));
  // With Alt a keyboard may give another letter; the place of the key still tells.
  const place = /^Key([A-Z])$/.exec(press.code)?.[1];
  if (place && place !== letter) found.push(spell(control, press.altKey, press.shiftKey, place));
  return found;
}

/** True if the combination would be typed into a text rather than command something. */
export function typesText(key: string): boolean {
  if (/^(Ctrl|Alt)\+/.test(key)) return false;
  return key !== 'Escape' && !/^(Shift\+)?F\d+$/.test(key);
}

function spell(control: boolean, alt: boolean, shift: boolean, key: string): string {
  return `${control ? 'Ctrl+' : ''}${alt ? 'Alt+' : ''}${shift ? 'Shift+' : ''}${key}`;
}
