// What a person has set, checked where it comes in: the server keeps it as plain JSON.

import type { Json } from '../protocol/messages';

export type Theme = 'system' | 'dark' | 'light';

export interface Settings {
  theme: Theme;
  codeSize: number;
  showWords: boolean;
  spaces: number;
  wrap: boolean;
  /** The fleet that was looked at last: its address, and files of the server's computer. */
  fleet: FleetAddress | null;
}

export interface FleetAddress {
  target: string;
  ca: string;
  login: string;
}

export const defaultSettings: Settings = {
  theme: 'system',
  codeSize: 12,
  showWords: true,
  spaces: 4,
  wrap: false,
  fleet: null,
};
export const codeSizes = [11, 12, 13, 14, 16, 18, 20];
export const indentSizes = [2, 4, 8];

export function readSettings(json: Json | undefined): Settings {
  const table = typeof json === 'object' && json !== null && !Array.isArray(json) ? json : {};
  const { theme, codeSize, showWords, spaces, wrap, fleet } = table;
  return {
    theme: theme === 'dark' || theme === 'light' ? theme : 'system',
    codeSize: oneOf(codeSize, codeSizes, defaultSettings.codeSize),
    showWords: showWords !== false,
    spaces: oneOf(spaces, indentSizes, defaultSettings.spaces),
    wrap: wrap === true,
    fleet: readFleet(fleet),
  };
}

function readFleet(json: Json | undefined): FleetAddress | null {
  if (typeof json !== 'object' || json === null || Array.isArray(json)) return null;
  const { target, ca, login } = json;
  if (typeof target !== 'string' || typeof ca !== 'string' || typeof login !== 'string')
    return null;
  return { target, ca, login };
}

function oneOf(value: Json | undefined, list: readonly number[], otherwise: number): number {
  return typeof value === 'number' && list.includes(value) ? value : otherwise;
}
