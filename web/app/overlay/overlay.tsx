import { Suspense } from 'react';
import { late } from '../parts/late';
import { useWindow } from '../hooks';
import Palette from './palette';

// The palette is there at once: what is typed behind Ctrl+K must not get lost.
const views = {
  palette: Palette,
  help: late(() => import('./help/help')),
  folder: late(() => import('../start/folder_chooser')),
  project: late(() => import('../start/new_project')),
  runFrom: late(() => import('../views/plan/run_from')),
  newToken: late(() => import('./new_token')),
  newTemplate: late(() => import('../panels/palette/new_template_sheet')),
};

/** What lies over the window for a moment. Esc and a click beside it end it; run keys still work. */
export function Overlay() {
  const name = useWindow((state) => state.overlay);
  const View = name ? views[name] : null;
  if (!View) return null;
  return (
    <Suspense fallback={null}>
      <View key={name} />
    </Suspense>
  );
}
