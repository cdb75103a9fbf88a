// What draws what tests took: loaded when it is to be shown.
import { late } from '../../../parts/late';

export const CoverageLayer = late(() => import('./coverage_layer'), 'button');
export const CoverageStrip = late(() => import('./coverage_strip'), 'button');
