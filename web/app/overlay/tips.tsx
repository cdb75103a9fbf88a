import { useLayoutEffect, useRef } from 'react';
import { kTipId, useTip } from './use_tip';

const kGap = 6;

/** What a button says of itself (parts/button.tsx, tipOf): one for the whole window, not one a button. */
export function Tips() {
  const tip = useTip();
  const frame = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (tip && frame.current) place(frame.current, tip.target.getBoundingClientRect());
  }, [tip]);
  if (!tip) return null;
  return (
    <div className="tip" id={kTipId} role="tooltip" ref={frame}>
      {tip.label}
    </div>
  );
}

/** Below the target's middle, above it where there is no room, never outside of the window. */
function place(frame: HTMLElement, target: DOMRect): void {
  const { offsetWidth: width, offsetHeight: height } = frame;
  const below = target.bottom + kGap;
  const top = below + height > innerHeight ? target.top - kGap - height : below;
  const middle = target.left + target.width / 2 - width / 2;
  const left = Math.min(Math.max(kGap, middle), innerWidth - width - kGap);
  frame.style.left = `${left}px`;
  frame.style.top = `${Math.max(0, top)}px`;
}
