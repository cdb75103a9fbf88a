/** "27 Nov 2026, 14:05", of a time of the wall. */
export const recordedAt = (wall: number): string =>
  new Date(wall).toLocaleString('en-GB', { dateStyle: 'medium', timeStyle: 'short' });
