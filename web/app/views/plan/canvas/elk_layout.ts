// The layout of ELK, in a worker that is fetched when it is first needed.

import ELK from 'elkjs/lib/elk-api.js';
import workerUrl from 'elkjs/lib/elk-worker.min.js?url';
import { elkGraph, type LayoutGraph } from '../../../../core/plan/tidy';
import { drawWords } from '../words';
import type { Point } from '../../../../core/plan/shape';

/** A layout that takes longer is cancelled. */
export const kLayoutMs = 10_000;

export class TooLong extends Error {}

/** Upper left corners, counted from the corner of all. Rejects when it takes too long. */
export async function elkLayout(graph: LayoutGraph): Promise<Map<string, Point>> {
  const elk = new ELK({ workerUrl });
  const late = new Promise<never>((_done, reject) =>
    setTimeout(() => reject(new TooLong(drawWords.tidyTooLong)), kLayoutMs),
  );
  try {
    const laid = await Promise.race([elk.layout(elkGraph(graph)), late]);
    return new Map((laid.children ?? []).map(({ id, x, y }) => [id, { x: x ?? 0, y: y ?? 0 }]));
  } finally {
    elk.terminateWorker();
  }
}
