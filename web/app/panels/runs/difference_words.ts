// The channels of a recording, and what was recorded in them, in the words of the studio.

import type { Json } from '../../../protocol/messages';

type Fields = Readonly<Record<string, Json>>;

const kLanes: Readonly<Record<string, string>> = {
  '/plan/trace': 'Plan',
  '/bus/events': 'Events',
  '/vagus/input': 'What was done from outside',
  '/world/scene': 'Things in the world',
  '/vagus/check': 'Checksum of the whole run',
  end: 'End of the run',
};
/** Their lines are told whole: where in the line they differ says no more. */
const kTold = /\/(plan\/trace|bus\/events|vagus\/input)$|^end$/;

/** "Variables of range: watch.distance", "Plan". */
export function laneWords(name: string, place = ''): string {
  const told = channelWords(name);
  return place === '' || kTold.test(name) ? told : `${told}: ${place}`;
}

function channelWords(name: string): string {
  const known = kLanes[name];
  if (known) return known;
  // The name of a robot may have slashes.
  const [, robot, rest] = /^\/robot\/(.+?)(\/(?:plan|bus|vagus|node)\/.+)?$/.exec(name) ?? [];
  if (robot !== undefined) return rest ? `${robot}: ${channelWords(rest)}` : robot;
  const [, node] = /^\/node\/(.+)\/variables$/.exec(name) ?? [];
  if (node !== undefined) return `Variables of ${node}`;
  const [, thing] = /^\/world\/poses (?:robot\/|object\/)?(.+)$/.exec(name) ?? [];
  return thing === undefined ? name : `Place of ${thing}`;
}

/** What was recorded there, JSON, as a person says it; what is of no known form stays as it is. */
export function recordedWords(name: string, json: string): string {
  let value: Json;
  try {
    value = JSON.parse(json) as Json;
  } catch {
    return json;
  }
  if (Array.isArray(value)) return value.map((one) => shown(one)).join(', ');
  if (typeof value !== 'object' || value === null) return String(value);
  return lineWords(name, value) ?? pairs(value);
}

function lineWords(name: string, line: Fields): string | null {
  const of = (key: string) => shown(line[key] ?? '');
  if (name.endsWith('/bus/events')) return `${of('name')}(${shown(line['args'] ?? [])})`;
  if (name.startsWith('/world/poses') && 'angle' in line)
    return `x ${metres(line['x'])}, y ${metres(line['y'])} m, ${of('angle')}°`;
  if (name === 'end') return `${of('result')}, after ${of('t')} s`;
  if (name.endsWith('/vagus/input')) return `${of('do')} ${of('value')}`.trim();
  return name.endsWith('/plan/trace') ? traceWords(line, of) : null;
}

function traceWords(line: Fields, of: (key: string) => string): string | null {
  switch (line['kind']) {
    case 'plan-start':
      return `${of('plan')} begins`;
    case 'plan-end':
      return `${of('plan')} ends: ${of('result')}`;
    case 'write':
      return `${of('variable')} = ${of('value')}, set by ${of('by')}`;
    case 'actor-start':
      return `${of('actor')} begins${line['in'] ? ` with ${of('in')}` : ''}`;
    case 'actor-end':
      return `${of('actor')} ends with ${of('state')}, which leads to ${target(of('target'))}`;
    case 'event':
      return `${of('supervisor')} raises ${of('event')}, which leads to ${target(of('target'))}`;
    case 'interrupted':
      return `${of('actor')} is interrupted`;
    default:
      return null;
  }
}

const target = (name: string) => name.replace(/^@/, '');

function metres(value: Json | undefined): string {
  return typeof value === 'number' ? value.toFixed(3) : shown(value ?? '');
}

function shown(value: Json): string {
  if (Array.isArray(value)) return value.map(shown).join(', ');
  return typeof value === 'object' && value !== null ? pairs(value) : String(value);
}

function pairs(value: Fields): string {
  return Object.entries(value)
    .map(([key, one]) => `${key} ${shown(one)}`)
    .join(', ');
}
