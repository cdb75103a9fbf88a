// What draws a comparison: loaded when there is one.
import { late } from '../../../parts/late';

export const DifferencesLayer = late(() => import('./differences_layer'));
export const DifferencesStrip = late(() => import('./differences_strip'));
