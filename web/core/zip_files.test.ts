import { describe, expect, test } from 'vitest';
import { CommandError } from './connection';
import { collectFiles } from './zip_files';

const refuse = (code: 'limit' | 'unavailable', what: string) => {
  throw new CommandError({ code, what });
};

describe('FilesOfAZip', () => {
  test('AFileThatIsTooLargeIsLeftOutAndNamed', async () => {
    const { contents, leftOut } = await collectFiles(['a.txt', 'film.bin', 'b.txt'], (path) =>
      Promise.resolve(path === 'film.bin' ? refuse('limit', 'too large') : btoa(path)),
    );
    expect(Object.keys(contents)).toEqual(['a.txt', 'b.txt']);
    expect(contents['b.txt']).toEqual(new TextEncoder().encode('b.txt'));
    expect(leftOut).toEqual([{ path: 'film.bin', why: 'too large' }]);
  });
  test('WithoutAServerThereIsNoZip', async () => {
    const lost = collectFiles(['a.txt'], () => Promise.resolve(refuse('unavailable', 'lost')));
    await expect(lost).rejects.toThrow('lost');
  });
});
