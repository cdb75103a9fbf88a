// Reading what a person may have written: what is not of the expected kind counts as missing. The
// checker says what is wrong with it.

import type { Json } from '../../protocol/messages';

export type Table = Record<string, Json>;

export function tableOf(value: Json | undefined): Table {
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? value : {};
}

export function textOf(value: Json | undefined): string {
  return typeof value === 'string' ? value : '';
}

export function memberOf(value: Json | undefined, key: string): Json | undefined {
  const table = tableOf(value);
  return Object.hasOwn(table, key) ? table[key] : undefined;
}

export function listOf(value: Json | undefined): readonly Json[] {
  return Array.isArray(value) ? value : [];
}
