// Narrower than any window in which panels can be beside each other.
export const kPhone = '(max-width: 600px)';

/** Whether this window is that of a telephone now; components ask usePhone(). */
export function isPhone(): boolean {
  return matchMedia(kPhone).matches;
}
