// What happened as a table, which is loaded when somebody asks for it.

import type { Happening } from '../protocol/messages';
import { csvOf } from './csv';

/** Happenings as a table for other programs: always these columns; arguments share one. */
export function happeningsCsv(items: readonly Happening[]): string {
  return csvOf([
    ['run', 'time', 'wall', 'kind', 'node', 'source', 'name', 'text', 'args'],
    ...items.map(({ run, t, wall, kind, node, source, name, text, args }) => [
      run,
      t,
      // Of a run that was run again nobody knows it.
      wall === 0 ? '' : new Date(wall).toISOString(),
      kind,
      node,
      source,
      name,
      text,
      args.join(' '),
    ]),
  ]);
}
