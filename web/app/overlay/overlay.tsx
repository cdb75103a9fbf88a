import { Suspense, useLayoutEffect } from 'react';
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

/** Until it is loaded, Escape ends it, and what is typed is kept for its field, unless a click chose another. */
function Coming() {
  const close = useCloseOverlay();
  useLayoutEffect(() => {
    const kept: string[] = [];
    let elsewhere = false;
    const clicked = () => void (elsewhere = true);
    const pressed = (event: KeyboardEvent) => {
      const { key, ctrlKey, altKey, metaKey } = event;
      const chord = (ctrlKey || altKey || metaKey) && !event.getModifierState('AltGraph');
      if (key === 'Escape') return close();
      // Stop has to get through.
      if (elsewhere || chord || /^F\d/.test(key)) return;
      // Also those that are not kept: Delete is not for what lies behind.
      event.preventDefault();
      event.stopPropagation();
      if (key === 'Backspace') kept.pop();
      else if (key.length === 1 || key === 'Enter') kept.push(key);
    };
    addEventListener('keydown', pressed, true);
    addEventListener('pointerdown', clicked, true);
    return () => {
      removeEventListener('pointerdown', clicked, true);
      removeEventListener('keydown', pressed, true);
      void typeAgain(kept);
    };
  }, [close]);
  return null;
}

/** The field has the keyboard once this drawing is done, and shows each key before the next one. */
async function typeAgain(kept: readonly string[]): Promise<void> {
  for (const key of kept) {
    await Promise.resolve();
    const field = document.activeElement;
    if (!field?.closest('.overlay')) return;
    if (key === 'Enter') (field as HTMLInputElement).form?.requestSubmit();
    // Old, but the only way that types as keys do, which undo takes back.
    else document.execCommand('insertText', false, key);
  }
}
