import {
  IconAlertTriangle,
  IconCircleCheck,
  IconInfoCircle,
  IconX,
  IconAlertOctagon,
} from '@tabler/icons-react';
import { useEffect } from 'react';
import { dismiss, type Toast } from '../../core/window_state';
import { useStudio, useWindow } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';

const icons = {
  error: IconAlertOctagon,
  warning: IconAlertTriangle,
  ok: IconCircleCheck,
  note: IconInfoCircle,
};
/** An error stays longer; a person may want to read it twice. */
const kShownMs = { error: 12_000, warning: 9_000, ok: 4_000, note: 6_000 };

/** Messages that never block: they go by themselves, and cover nothing that is used. */
export function Toasts() {
  const toasts = useWindow((state) => state.toasts);
  return (
    <div className="toasts" role="log" aria-live="polite" aria-label={text.toasts}>
      {toasts.map((toast) => (
        <ToastView key={toast.id} toast={toast} />
      ))}
    </div>
  );
}

function ToastView({ toast }: { toast: Toast }) {
  const { window: store, world } = useStudio();
  const Icon = icons[toast.kind];
  useEffect(
    () => world.later(kShownMs[toast.kind], () => dismiss(store, toast.id)),
    [store, world, toast],
  );
  return (
    <div className={`toast toast--${toast.kind}`}>
      <Icon className="icon" size={16} stroke={kStroke} aria-hidden />
      <span>{toast.text}</span>
      <Button
        kind="plain"
        small
        tip={text.close}
        icon={<IconX size={14} stroke={kStroke} />}
        onClick={() => dismiss(store, toast.id)}
      />
    </div>
  );
}
