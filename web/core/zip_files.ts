// The files of a project for a zip: what the server does not give is left out and named, so that one
// large recording does not keep everything else from being exported.

import { CommandError } from './connection';

export interface Collected {
  contents: Record<string, Uint8Array>;
  /** Those that were refused, and why. */
  leftOut: { path: string; why: string }[];
}

/** bytesOf: gives a file as base64, or fails. Only a refusal of that file is passed over. */
export async function collectFiles(
  paths: readonly string[],
  bytesOf: (path: string) => Promise<string>,
): Promise<Collected> {
  const collected: Collected = { contents: {}, leftOut: [] };
  for (const path of paths) {
    try {
      collected.contents[path] = Uint8Array.from(atob(await bytesOf(path)), (letter) =>
        letter.charCodeAt(0),
      );
    } catch (problem) {
      const why = refusal(problem);
      if (why === null) throw problem;
      collected.leftOut.push({ path, why });
    }
  }
  return collected;
}

const ofTheFile = new Set(['limit', 'not_found', 'failed', 'bad_input']);

function refusal(problem: unknown): string | null {
  if (!(problem instanceof CommandError)) return null;
  return ofTheFile.has(problem.problem.code) ? problem.problem.what : null;
}
