import { Suspense, useEffect } from 'react';
import { late } from '../parts/late';
import { useCloseOverlay } from '../parts/overlay_frame';
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
    <Suspense fallback={<Coming />}>
      <View key={name} />
    </Suspense>
  );
}

/** Escape ends it before it is there, too: the first time it has to be loaded. */
function Coming() {
  const close = useCloseOverlay();
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => event.key === 'Escape' && close();
    document.addEventListener('keydown', pressed);
    return () => document.removeEventListener('keydown', pressed);
  }, [close]);
  return null;
}
