// A template of one's own: which names are good, said while they are typed. The server has the last
// word.

import type { PlanToolbox, ScriptPart, SharedFile } from '../../protocol/messages';
import { partOf } from '../paths';

export interface WantedTemplate {
  name: string;
  kind: 'actor' | 'supervisor';
  /** The script of the node that does the work. */
  script: string;
  help: string;
}

/** Scripts that can do work for plans: those of files that declare events. */
export function workingScripts(parts: readonly ScriptPart[]): ScriptPart[] {
  return parts.filter((one) => partOf(one.doc).part > 0);
}

export type NameFault = 'empty' | 'form' | 'taken' | 'event';

export function faultOfName(
  { name, script }: WantedTemplate,
  toolboxes: readonly PlanToolbox[],
  files: readonly SharedFile[],
): NameFault | null {
  if (name === '') return 'empty';
  if (!/^[A-Za-z_]\w{0,99}$/.test(name)) return 'form';
  if (toolboxes.some((one) => one.templates.some((template) => template.name === name)))
    return 'taken';
  const stem = `${name.slice(0, 1).toLowerCase()}${name.slice(1)}.`;
  const { file } = partOf(script);
  const events = files.find((one) => one.path === file)?.events ?? [];
  return events.some((one) => one.name.startsWith(stem)) ? 'event' : null;
}
