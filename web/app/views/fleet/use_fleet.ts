// How the parts of the page look at the fleet.

import { useMemo } from 'react';
import { doings, listOf, type Counts, countDoings, type Robots } from '../../../core/fleet';
import { fleetDesk, type FleetDesk } from '../../../core/fleet_desk';
import { useChanges, useLink, usePart, useStudio } from '../../hooks';

const none: Robots = {};

export function useFleetDesk(): FleetDesk {
  const desk = fleetDesk(useStudio());
  useChanges(desk.changed);
  return desk;
}

/** What is shown is what robots do now: both ways to them are there. */
export function useIsConnected(): boolean {
  const link = useLink();
  const broker = usePart('fleet', {}, (is) => is?.state);
  return link.state === 'open' && broker === 'connected';
}

/** Names of the robots that are shown, in their order; another list only if it differs. */
export function useList(): readonly string[] {
  const { query, sort } = useFleetDesk();
  const isConnected = useIsConnected();
  const key = usePart('fleet', {}, (is) =>
    listOf(is?.robots ?? none, query, sort, isConnected).join('\n'),
  );
  return useMemo(() => (key === '' ? [] : key.split('\n')), [key]);
}

/** How many robots do what. */
export function useCounts(): Counts {
  const isConnected = useIsConnected();
  const key = usePart('fleet', {}, (is) =>
    Object.values(countDoings(is?.robots ?? none, isConnected)).join(' '),
  );
  return useMemo(() => {
    const counts = key.split(' ').map(Number);
    return Object.fromEntries(doings.map((doing, at) => [doing, counts[at] ?? 0])) as Counts;
  }, [key]);
}
