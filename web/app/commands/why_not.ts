// Why a command cannot be done now, in a sentence for the palette and for who pressed its key.

import { answers } from '../../core/connection';
import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { text } from '../text';
import { projectOf } from './looks';

const words = text.whyNot;

/** Commands for those who only look, too: what they lack is never control. */
const kLooks = new RegExp(
  `^(${[
    'past(?!\\.(continue|stay|decided)$)',
    'edit\\.(definition|references|complete|find)$',
    'events\\.(?!send$)',
    'draw\\.(script|log|why|open|copy|properties|none)$',
    'world\\.(next|previous|fit|zoom|follow|why|solid|rays|trails|clearTrails|grid|picture|list|open)',
    'problem\\.(next|previous)$',
    'timeline|plots|watch|view|listing|plan\\.show|fleet|file\\.export$',
  ].join('|')})`,
);
/** Commands that change what runs. */
const kActs =
  /^(run\.(?!end)|plan\.(?!show|stop)|node\.(?!stop)|tests\.run$|draw\.(into|runFrom)$)/;
/** These are the studio's alone; Ctrl and a letter does what the browser does with it. */
const kOwnKeys = /(^|\+)F\d+$|^(Ctrl\+)?Alt\+/;

/** '' if it can be done. */
export function whyNot(studio: Studio, command: Command): string {
  const { id, within } = command;
  if (studio.registry.isEnabled(id)) return '';
  if (projectOf(studio) === null) return words.noProject;
  if (!studio.drives && !kLooks.test(id)) return isAway(studio) ? words.away : words.viewOnly;
  if (studio.past.at !== null && kActs.test(id)) return words.looksBack;
  const why = command.why?.() ?? '';
  if (why !== '') return why;
  const own: Partial<Record<string, string>> = words.of;
  const group = id.slice(0, id.indexOf('.') + 1);
  return own[id] ?? own[group] ?? (within === undefined ? words.notNow : words.elsewhere);
}

const isAway = (studio: Studio) => !answers(studio.connection.link);

/** So is a letter, or what deletes, for who is at a place that has commands on them and types nothing. */
const kKeysOfPlace = /^(Shift\+)?(.|Delete|Backspace)$/;

/** Says why the key of a command does nothing now; false where the key is left to the browser. */
export function refuse(studio: Studio, command: Command, key: string): boolean {
  const isOurs = kOwnKeys.test(key) || (command.within !== undefined && kKeysOfPlace.test(key));
  if (!isOurs || projectOf(studio) === null) return false;
  const { title } = command;
  toast(
    studio.window,
    'note',
    `${title}${title.endsWith('?') ? '' : ':'} ${whyNot(studio, command)}`,
  );
  return true;
}
