import { expect, test } from 'vitest';
import { kRetryWaitsMs, retried } from './retry';

/** Fails so many times before it answers. */
function failing(times: number) {
  let count = 0;
  return () => {
    count++;
    return count <= times ? Promise.reject(new Error(`try ${count}`)) : Promise.resolve(count);
  };
}

test('ItIsTriedAgainUntilItSucceedsWithPausesThatGrow', async () => {
  const pauses: number[] = [];
  const pause = (ms: number) => Promise.resolve(void pauses.push(ms));
  expect(await retried(failing(2), pause)).toBe(3);
  expect(pauses).toEqual([250, 750]);
});

test('TheLastFailureIsToldOnceAllTriesAreUsed', async () => {
  const pause = () => Promise.resolve();
  expect(await retried(failing(kRetryWaitsMs.length), pause)).toBe(4);
  await expect(retried(failing(kRetryWaitsMs.length + 1), pause)).rejects.toThrow('try 4');
});
