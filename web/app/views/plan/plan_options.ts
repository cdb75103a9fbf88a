// How plans are looked at: the same in all views of the window, kept with the project.

import { useStore } from 'zustand';
import { createStore, type StoreApi } from 'zustand/vanilla';
import { memberOf } from '../../../core/plan/json';
import type { Studio } from '../../../core/studio';
import { keepState } from '../../commands/looks';
import { useStudio } from '../../hooks';

export interface PlanOptions {
  /** The file as text beside the drawing. */
  text: boolean;
  /** The C++ program that it is, beside the drawing. */
  code: boolean;
  /** What it does, as a list. */
  live: boolean;
  /** All data arrows. */
  data: boolean;
  map: boolean;
}

const defaults: PlanOptions = { text: false, code: false, live: false, data: false, map: true };
const names = ['text', 'code', 'live', 'data', 'map'] as const;

const stores = new WeakMap<Studio, StoreApi<PlanOptions>>();

export function planOptionsOf(studio: Studio): StoreApi<PlanOptions> {
  const known = stores.get(studio);
  if (known) return known;
  const kept = memberOf(studio.topics.get('state', {})?.values, 'plan');
  const options = { ...defaults };
  for (const name of names) {
    const value = memberOf(kept, name);
    if (typeof value === 'boolean') options[name] = value;
  }
  const made = createStore<PlanOptions>()(() => options);
  stores.set(studio, made);
  return made;
}

export function usePlanOptions(): PlanOptions {
  return useStore(planOptionsOf(useStudio()));
}

export function togglePlanOption(studio: Studio, name: keyof PlanOptions, on?: boolean): void {
  const store = planOptionsOf(studio);
  store.setState({ [name]: on ?? !store.getState()[name] });
  keepState(studio, 'plan', { ...store.getState() });
}
