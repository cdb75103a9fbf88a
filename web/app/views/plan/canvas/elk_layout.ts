// The layout of ELK, in a worker that is fetched when it is first needed.

import ELK from 'elkjs/lib/elk-api.js';
import workerUrl from 'elkjs/lib/elk-worker.min.js?url';
import type { LayoutGraph } from '../../../../core/plan/tidy';
import type { Point } from '../../../../core/plan/shape';

/** A layout that takes longer is given up. */
export const kLayoutMs = 10_000;

const options = {
  'elk.algorithm': 'layered',
  'elk.direction': 'RIGHT',
  'elk.edgeRouting': 'ORTHOGONAL',
  // Between columns and rows: room for the lanes of arrows.
  'elk.layered.spacing.nodeNodeBetweenLayers': '88',
  'elk.spacing.nodeNode': '56',
  'elk.spacing.componentComponent': '64',
  'elk.layered.considerModelOrder.strategy': 'NODES_AND_EDGES',
};

/** Upper left corners, counted from the corner of all. Rejects when it takes too long. */
export async function elkLayout(graph: LayoutGraph): Promise<Map<string, Point>> {
  const elk = new ELK({ workerUrl });
  const late = new Promise<never>((_done, reject) =>
    setTimeout(() => reject(new Error('the layout takes too long')), kLayoutMs),
  );
  try {
    const laid = await Promise.race([elk.layout(elkGraph(graph)), late]);
    return new Map((laid.children ?? []).map(({ id, x, y }) => [id, { x: x ?? 0, y: y ?? 0 }]));
  } finally {
    elk.terminateWorker();
  }
}

function elkGraph({ boxes, edges }: LayoutGraph) {
  return {
    id: 'plan',
    layoutOptions: options,
    children: boxes.map((one) => ({ ...one })),
    edges: edges.map(({ from, to }, index) => ({
      id: String(index),
      sources: [from],
      targets: [to],
    })),
  };
}
