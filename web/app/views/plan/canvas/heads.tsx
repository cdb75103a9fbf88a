import { createContext, useContext } from 'react';

/**
 * Ids are the whole page's: with one for all canvases the heads would be those of the first one, which has none to
 * show while its tab is hidden.
 */
export const HeadsContext = createContext('');

export function useHead(kind: 'plain' | 'near' | 'taken'): string {
  return `url(#plan-head-${kind}-${useContext(HeadsContext)})`;
}

/** The heads of arrows, for the canvas around them. */
export function Heads() {
  const canvas = useContext(HeadsContext);
  return (
    <defs>
      {(['plain', 'near', 'taken'] as const).map((kind) => (
        <marker
          key={kind}
          id={`plan-head-${kind}-${canvas}`}
          className={`parrow__head parrow__head--${kind}`}
          viewBox="0 0 10 9"
          refX="1"
          refY="4.5"
          markerWidth="11"
          markerHeight="10"
          markerUnits="userSpaceOnUse"
          orient="auto"
        >
          <path d="M0 0L10 4.5L0 9z" />
        </marker>
      ))}
    </defs>
  );
}
