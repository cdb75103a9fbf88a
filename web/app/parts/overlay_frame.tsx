import { useCallback, useEffect, useRef, type ReactNode } from 'react';
import { update } from '../../core/window_state';
import { useStudio } from '../hooks';

export function useCloseOverlay(): () => void {
  const { window: store } = useStudio();
  return useCallback(() => update(store, (draft) => void (draft.overlay = null)), [store]);
}

/** The frame of an overlay: gives the focus back where it was. */
export function OverlayFrame({ label, children }: { label: string; children: ReactNode }) {
  const close = useCloseOverlay();
  const before = useRef(document.activeElement);
  useEffect(() => {
    const { current } = before;
    return () => {
      const lost = document.activeElement === document.body || document.activeElement === null;
      if (lost && current instanceof HTMLElement) current.focus();
    };
  }, []);
  return (
    <div
      className="overlay"
      onMouseDown={(event) => event.target === event.currentTarget && close()}
    >
      <div
        role="dialog"
        aria-label={label}
        onKeyDown={(event) => event.key === 'Escape' && (event.stopPropagation(), close())}
      >
        {children}
      </div>
    </div>
  );
}
