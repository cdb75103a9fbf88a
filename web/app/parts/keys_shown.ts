/** The keyboard has Cmd and Option where others have Ctrl and Alt. */
export const onApple = /Mac|iPhone|iPad/.test(navigator.platform);

/**
 * Keys as they are named on the keyboard of who reads. Option and a letter type on one of Apple: there
 * Ctrl+Option means what Alt means elsewhere (core/keys.ts).
 */
export function keysShown(keys: string, isApple = onApple): string {
  // Cmd+Space is the system's.
  if (!isApple || keys === 'Ctrl+Space') return keys;
  if (/^Alt\+(Shift\+)?[A-Z]$/.test(keys)) return keys.replace('Alt', 'Ctrl+Option');
  return keys.replace('Ctrl', 'Cmd').replace('Alt', 'Option');
}
