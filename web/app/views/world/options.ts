// How worlds are looked at: the same in all views of the window, kept with the project.

import { useStore } from 'zustand';
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Json } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { keepState } from '../../commands/looks';
import { useStudio } from '../../hooks';

export interface WorldOptions {
  solid: boolean;
  rays: boolean;
  trails: boolean;
  /** Metres of a trail; 0: all of it. */
  trailLength: number;
  grid: boolean;
  picture: boolean;
  list: boolean;
  snap: boolean;
  /** What Live and Edit change has been read. */
  explained: boolean;
}

export const trailLengths = [1, 5, 20, 0];

const defaults: WorldOptions = {
  solid: false,
  rays: true,
  trails: true,
  trailLength: 20,
  grid: true,
  picture: true,
  list: true,
  snap: true,
  explained: false,
};

type Store = StoreApi<WorldOptions>;
const stores = new WeakMap<Studio, Store>();

export function optionsOf(studio: Studio): Store {
  const known = stores.get(studio);
  if (known) return known;
  const made = createStore<WorldOptions>()(() => read(keptOf(studio)));
  stores.set(studio, made);
  return made;
}

export function useWorldOptions(): WorldOptions {
  return useStore(optionsOf(useStudio()));
}

export function setOption(studio: Studio, change: Partial<WorldOptions>): void {
  const store = optionsOf(studio);
  store.setState(change);
  keepState(studio, 'world', { ...store.getState() });
}

export function toggleOption(
  studio: Studio,
  name: Exclude<keyof WorldOptions, 'trailLength'>,
): void {
  setOption(studio, { [name]: !optionsOf(studio).getState()[name] });
}

function keptOf(studio: Studio): Json | undefined {
  const values = studio.topics.get('state', {})?.values;
  return typeof values === 'object' && values !== null && !Array.isArray(values)
    ? values['world']
    : undefined;
}

function read(kept: Json | undefined): WorldOptions {
  const table = typeof kept === 'object' && kept !== null && !Array.isArray(kept) ? kept : {};
  const on = (name: keyof WorldOptions) =>
    typeof table[name] === 'boolean' ? table[name] : Boolean(defaults[name]);
  const length = trailLengths.find((one) => one === table['trailLength']);
  return {
    solid: on('solid'),
    rays: on('rays'),
    trails: on('trails'),
    trailLength: length ?? defaults.trailLength,
    grid: on('grid'),
    picture: on('picture'),
    list: on('list'),
    snap: on('snap'),
    explained: on('explained'),
  };
}
