// Tries again what may fail because the connection or the server was away for a moment.

/** How long after each failure the next try begins; there is one try more than there are entries. */
export const kRetryWaitsMs: readonly number[] = [250, 750, 2000];

export async function retried<T>(
  attempt: () => Promise<T>,
  pause: (milliseconds: number) => Promise<void> = passed,
): Promise<T> {
  for (const wait of kRetryWaitsMs) {
    try {
      return await attempt();
    } catch {
      // The last try says why it failed.
      await pause(wait);
    }
  }
  return attempt();
}

function passed(milliseconds: number): Promise<void> {
  return new Promise((done) => setTimeout(done, milliseconds));
}
