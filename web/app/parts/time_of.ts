/** "14:05", of a time of the wall. */
export function timeOf(wall: number): string {
  return new Date(wall).toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' });
}
