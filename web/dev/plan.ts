// A development tool: a plan that pretends to run.

import type { Json, Line, Topics } from '../protocol/messages';
import type { Model } from './model';

export interface StandInPlan {
  state: Topics['plan']['is']['state'];
  began: number;
  walldist: Json;
}

const doc = 'follow-wall/WallFollow.plan.json';
const path = [
  ['searchFirstWall', 'Forward', 8],
  ['findWallAngle', 'SearchWall', 1.6],
  ['parallelToWall', 'Turn', 1.9],
  ['followWall', 'WallForward', 30],
] as const;

export function planOf(model: Model): Topics['plan']['is'] {
  const { plan, clock } = model;
  if (plan.state === 'none') return { state: 'none', t: 0, levels: [], story: [] };
  let since = plan.began;
  let index = 0;
  const story: Line[] = [];
  while (index < path.length - 1 && since + (path[index]?.[2] ?? 0) < clock.t) {
    since += path[index]?.[2] ?? 0;
    const [actor] = path[index] ?? [''];
    story.push({
      number: index,
      t: since,
      kind: 'note',
      text: `${actor}: ${index === 1 ? 'WallFound' : 'ForwardSuccessful'} → ${path[index + 1]?.[0]}`,
    });
    index++;
  }
  const [actor, template] = path[index] ?? ['', ''];
  if (plan.state === 'ended')
    return { state: 'ended', doc, t: clock.t, result: 'Interrupted', levels: [], story };
  return {
    state: plan.state,
    doc,
    t: clock.t,
    levels: [
      {
        path: 'WallFollow',
        doc,
        actor,
        template,
        activation: index + 1,
        since,
        inputs: { distance: 30, speed: 20 },
        variables: [
          { name: 'walldist', type: 'float', value: plan.walldist, unit: 'cm' },
          { name: 'wallangle', type: 'float', value: 63.5, unit: 'deg' },
          { name: 'share', type: 'float', value: 1, unit: '' },
        ],
        supervisors: [
          {
            name: 'escape',
            global: true,
            watching: true,
            events: ['EscapeButtonPressed'],
          },
          { name: 'noWay', global: true, watching: false, events: ['NoProgress'] },
          {
            name: 'touch',
            global: false,
            watching: true,
            events: ['TouchSensorPressed'],
          },
          { name: 'checkLane', global: false, watching: true, events: ['LaneNotFree'] },
        ],
      },
    ],
    story,
  };
}
