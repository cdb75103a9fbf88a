// What shows a try: loaded when there is one.
import { late } from '../../../parts/late';

export const TryBar = late(() => import('./try_bar'));
