// Words of the page of a fleet: apart from text.ts, as they come with that page alone.

import type { FleetEvent, RolloutRobot } from '../../../protocol/messages';
import type { Doing, Sort } from '../../../core/fleet';
import type { Verb } from '../../../core/fleet_desk';
import type { Rollout } from '../../../core/rollout';
import { counted } from '../../text';
import { keysShown } from '../../parts/keys_shown';

const robots = (count: number) => counted(count, 'robot', 'robots');
const listed = (names: readonly string[]) =>
  names.length <= 12
    ? names.join(', ')
    : `${names.slice(0, 12).join(', ')} and ${names.length - 12} more`;

export const words = {
  region: 'Fleet',
  title: (fleet: string) => `Fleet ${fleet}`,
  as: (user: string) => `as ${user}`,
  count: robots,
  doing: {
    fault: 'fault',
    stuck: 'stuck',
    lost: 'lost',
    waiting: 'waiting',
    running: 'running',
    paused: 'paused',
    stopped: 'stopped',
    offline: 'offline',
  } satisfies Record<Doing, string>,
  doingHelp: {
    fault: 'A node has a fault, or its run has died.',
    stuck: 'It is connected, but has told nothing for more than 6 s: its program hangs.',
    lost: 'The broker does not hear it any more, and it did not say goodbye.',
    waiting: 'It has not told what it does since this studio looks.',
    running: 'Its plan or scripts run.',
    paused: 'It is paused.',
    stopped: 'Nothing runs.',
    offline: 'It said goodbye.',
  } satisfies Record<Doing, string>,
  show: (count: number, doing: string) => `${count} ${doing}: show these`,
  stopAll: 'Stop all',
  stopAllLong: 'Stop all robots of the fleet',
  stopAllTip: 'Stops every robot of the fleet, also those that are not shown',
  link: {
    connecting: (target: string) => `Looking for the broker of ${target}…`,
    lost: 'The broker is gone. The tiles show what robots told last; looking for it…',
    page: 'The tiles show what robots told last.',
  },
  find: 'Name, state, actor, group, problem',
  findRobots: 'Find robots of the fleet',
  sort: 'Sort by',
  sorts: {
    name: 'Name',
    state: 'Worst first',
    since: 'Longest first',
    version: 'Version',
  } satisfies Record<Sort, string>,
  tiles: 'Robots',
  tilesHelp: `Arrows go from robot to robot, Space chooses, Shift extends, ${keysShown('Ctrl+A')} chooses all, Enter opens its studio.`,
  none: 'No robot has been in this fleet yet',
  noneHelp: 'Start one: vagus serve PROJECT --start --fleet',
  noMatch: 'No robot matches what is looked for.',
  shown: (shown: number, all: number) => (shown === all ? '' : `${shown} of ${robots(all)} shown`),
  chosen: (count: number) => (count === 0 ? 'None chosen' : `${count} chosen`),
  chosenHidden: (count: number) => `${count} of them not shown`,
  chooseAll: 'Choose all',
  chooseNone: 'Choose none',
  chooseFirst: 'Choose robots first: click, or Space',
  choose: 'Choose',
  open: 'Opens its own studio',
  noStudio: (name: string) => `${name} has not told the address of a studio.`,
  offlineStudio: (name: string) => `${name} is not connected; its studio cannot be opened.`,
  orders: 'What the chosen robots are told',
  verbs: {
    stop: 'Stop',
    pause: 'Pause',
    continue: 'Continue',
    start: 'Start',
    emit: 'Send an event',
    set: 'Set a variable',
    raise: 'Raise an event',
  } satisfies Record<Verb, string>,
  form: {
    event: 'Event',
    args: 'Arguments',
    argsHint: 'none',
    noArgs: 'Arguments are whole numbers from -32768 to 32767, with spaces between.',
    noEvent: 'Type the name of an event first.',
    variable: 'Variable',
    variableHint: 'thymio-II.speed',
    noVariable: 'Type NODE.NAME, or NAME of a variable of the plan.',
    values: 'Value',
    noValues: 'A value is a whole number from -32768 to 32767; several with spaces between.',
    send: 'Send',
    set: 'Set',
    close: 'Close',
  },
  deploy: {
    button: 'Deploy',
    title: 'Deploy another version',
    what: (project: string, chosen: number, all: number) =>
      `${project}, as it is saved, for ${chosen === 0 ? `all ${robots(all)}` : chosen === 1 ? 'the chosen robot' : `the ${robots(chosen)} that are chosen`}.`,
    noProject: 'No project is open whose version robots could get: open one beside the fleet.',
    steps: 'Steps',
    help: 'How many robots have it after each step. The first one that is not well ends it.',
    deploy: 'Deploy',
    unsaved: (files: readonly string[]) => `Unsaved changes in ${listed(files)}.`,
    saveAll: 'Save all',
    without: 'Deploy without these changes',
    decide: 'Save all, or deploy without these changes.',
  },
  rollout: {
    title: 'Roll-out',
    table: 'What became of each robot',
    robot: 'Robot',
    became: 'Result',
    summary: (back: boolean, version: string, well: number, all: number) =>
      `${back ? 'Roll back' : 'Deploy'} ${version}: ${well} of ${robots(all)} well`,
    states: {
      none: '',
      running: 'under way',
      well: 'done',
      failed: 'ended: a robot is not well',
      left: 'left',
    } satisfies Record<Rollout['state'], string>,
    by: (who: string) => `by ${who}`,
    row: (is: RolloutRobot['is'], why: string) =>
      `${is === 'later' ? 'as it was' : is}${why === '' ? '' : `: ${why}`}`,
    more: (count: number) => `and ${count} more`,
    stop: 'Stop roll-out',
    back: 'Roll back',
  },
  report: {
    sent: (what: string, count: number | 'all') =>
      `${what}: ${count === 'all' ? 'all robots' : robots(count)}…`,
    nobody: (what: string) => `${what}: no robot is there.`,
    done: (what: string, count: number, of: number) =>
      count === of
        ? `${what}: done by ${robots(of)}.`
        : `${what}: done by ${count} of ${robots(of)}.`,
    silent: (names: readonly string[]) => `Did not answer: ${listed(names)}.`,
    away: (names: readonly string[]) => `Not connected: ${listed(names)}.`,
    refused: (name: string, why: string) =>
      why === '' ? `${name}: not done.` : `${name}: ${why}.`,
    failed: (what: string, why: string) => `${what}: ${why}`,
    chooseThese: 'Choose these',
    dismiss: 'Dismiss',
  },
  since: (span: string) => `for ${span}`,
  silentFor: (span: string) => `told nothing for ${span}`,
  vagus: (version: string) => `Vagus ${version}`,
  events: {
    title: 'Events',
    label: 'Events of the fleet, the newest first',
    find: 'Robot or event',
    kinds: 'Kinds',
    kind: {
      event: 'Events',
      connection: 'Comings and goings',
      order: 'Orders',
    } satisfies Record<FleetEvent['kind'], string>,
    chosen: 'Of the chosen robots only',
    none: 'Nothing has happened yet.',
    noMatch: 'Nothing matches.',
    leftOut: (count: number) => `${count} left out`,
    leftOutHelp: 'This page or the network was slow: the server left them out',
    shown: (shown: number, all: number) => `${shown} of ${all}`,
  },
};
