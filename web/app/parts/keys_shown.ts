/** The keyboard has Cmd and Option where others have Ctrl and Alt. */
export const onApple = /Mac|iPhone|iPad/.test(navigator.platform);

/**
 * Keys by the names on the reader's keyboard. On Apple keyboards Option and a letter type a character, so
 * Ctrl+Option stands for Alt there (core/keys.ts).
 */
export function keysShown(keys: string, isApple = onApple): string {
  // Cmd+Space is the system's.
  if (!isApple || keys === 'Ctrl+Space') return keys;
  if (/^Alt\+(Shift\+)?[A-Z]$/.test(keys)) return keys.replace('Alt', 'Ctrl+Option');
  return keys.replace('Ctrl', 'Cmd').replace('Alt', 'Option');
}
