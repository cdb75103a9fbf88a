// Keys: how a combination is written, shown and recognised.

export interface KeyPress {
  key: string;
  code: string;
  ctrlKey: boolean;
  shiftKey: boolean;
  altKey: boolean;
  metaKey: boolean;
  getModifierState?(name: string): boolean;
}

/** "Ctrl+Shift+F" in one spelling, so that two spellings of one key are seen to clash. */
export function normalKey(text: string): string {
  const parts = text === '+' ? ['+'] : text.split('+');
  const key = parts.pop() ?? '';
  const has = (name: string) => parts.some((part) => part.toLowerCase() === name);
  return spell(has('ctrl'), has('alt'), has('shift'), key.length === 1 ? key.toUpperCase() : key);
}

/**
 * The spellings by which a press can be meant, the exact one first; "?" is met with or without Shift.
 * Characters typed with AltGr, or with Option on Apple keyboards, are typed: they are no shortcuts.
 */
export function pressedKeys(press: KeyPress, isApple = false): string[] {
  const { key, altKey, shiftKey } = press;
  const isOne = [...key].length === 1;
  // Option alone types. With Control, which types nothing, it is the Alt of other keyboards.
  const own = isApple && altKey && press.ctrlKey && !press.metaKey ? letterOf(press) : undefined;
  if (own !== undefined) return [spell(false, true, shiftKey, own)];
  const isOption = isApple && altKey && !press.ctrlKey && !press.metaKey;
  const isTyped = isOption || (press.getModifierState?.('AltGraph') ?? false);
  if (isTyped && (isOne || key === 'Dead')) return [];
  const control = press.ctrlKey || press.metaKey;
  const letter = key === ' ' ? 'Space' : isOne ? key.toUpperCase() : key;
  const found = [spell(control, altKey, shiftKey, letter)];
  if (isOne && shiftKey && !/\p{L}/u.test(key)) found.push(spell(control, altKey, false, letter));
  // A keyboard of another script has the letters of ours at their places.
  const place = placeOf(press);
  if (place && isOne && /\p{L}/u.test(key) && !/\p{Script=Latin}/u.test(key))
    found.push(spell(control, altKey, shiftKey, place));
  return found;
}

/** What is on the key, also where Option makes another letter of it. */
function letterOf(press: KeyPress): string | undefined {
  return /^[a-z]$/i.test(press.key) ? press.key.toUpperCase() : placeOf(press);
}

function placeOf({ code }: KeyPress): string | undefined {
  return /^Key([A-Z])$/.exec(code)?.[1];
}

/** True if the combination would be typed into a text rather than command something. */
export function typesText(key: string): boolean {
  if (/^(Ctrl|Alt)\+/.test(key)) return false;
  return key !== 'Escape' && !/^(Shift\+)?F\d+$/.test(key);
}

function spell(control: boolean, alt: boolean, shift: boolean, key: string): string {
  return `${control ? 'Ctrl+' : ''}${alt ? 'Alt+' : ''}${shift ? 'Shift+' : ''}${key}`;
}
