/** "14:05", of a time of the wall. */
export function timeOf(wall: number): string {
  return new Date(wall).toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' });
}

/** "27 Nov 2026, 14:05", of a time of the wall. */
export const recordedAt = (wall: number): string =>
  new Date(wall).toLocaleString('en-GB', { dateStyle: 'medium', timeStyle: 'short' });
