// From how far the canvas is looked at, and so how much is drawn: nobody reads the states of 500
// actors at once, and drawing them takes its time.

import { useStore } from '@xyflow/react';
import { createContext, useContext, useEffect, useState } from 'react';

/** names: letters of names grow, those of states and events go; far: boxes and lines only. */
export type Distance = 'near' | 'names' | 'far';

/** Zoom below which states and events cannot be read. */
export const kLegible = 0.75;
/** Zoom below which names cannot be read either. */
const kBlurred = 0.4;
/** Elements of a plan above which only what is seen is drawn, and from far away only boxes. */
export const kManyNodes = 300;

export function useDistance(nodes: number): Distance {
  const many = nodes > kManyNodes;
  return useStore(({ transform: [, , zoom], width }) => {
    // The whole of it will be fitted in as soon as its room is known.
    if (many && width === 0) return 'far';
    if (zoom >= kLegible) return 'near';
    return many && zoom < kBlurred ? 'far' : 'names';
  });
}

/** False at first: what of a large plan is drawn only once the plan itself is. */
export function useAfterwards(): boolean {
  const [is, become] = useState(false);
  useEffect(() => {
    const timer = setTimeout(() => become(true), kAfterwardsMs);
    return () => clearTimeout(timer);
  }, []);
  return is;
}

const kAfterwardsMs = 500;

export const DistanceContext = createContext<Distance>('near');

export const useFar = () => useContext(DistanceContext) === 'far';
