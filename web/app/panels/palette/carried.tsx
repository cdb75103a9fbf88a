// A template that a finger carries onto the plan. What browsers drag themselves is for a mouse, or waits for
// a long press.
import { useRef, useState, type PointerEvent } from 'react';
import { createPortal } from 'react-dom';
import { kTemplateData } from '../../views/plan/template_drag';

/** So far a finger goes sideways before it carries something; up and down it scrolls the list. */
const kSidewaysPx = 12;

interface Spot {
  x: number;
  y: number;
}

/** Handlers of the button whose template it is, and where the finger has it now. */
export function useCarried(data: string, can: boolean) {
  const from = useRef<Spot | null>(null);
  const [at, carry] = useState<Spot | null>(null);
  const end = () => {
    from.current = null;
    carry(null);
  };
  return {
    at,
    hands: {
      onPointerDown({ pointerType, clientX: x, clientY: y }: PointerEvent) {
        if (can && pointerType === 'touch') from.current = { x, y };
      },
      onPointerMove({ clientX: x, clientY: y }: PointerEvent) {
        if (from.current && (at || Math.abs(x - from.current.x) >= kSidewaysPx)) carry({ x, y });
      },
      onPointerUp({ clientX: x, clientY: y }: PointerEvent) {
        if (at) drop(data, { x, y });
        end();
      },
      onPointerCancel: end,
    },
  };
}

/** As if a mouse had dropped it there. */
function drop(data: string, { x, y }: Spot): void {
  const dataTransfer = new DataTransfer();
  dataTransfer.setData(kTemplateData, data);
  const init = { bubbles: true, cancelable: true, clientX: x, clientY: y, dataTransfer };
  document.elementFromPoint(x, y)?.dispatchEvent(new DragEvent('drop', init));
}

export function Carried({ at, name }: { at: Spot; name: string }) {
  return createPortal(
    <div className="plantool__carried" style={{ left: at.x, top: at.y }} aria-hidden>
      {name}
    </div>,
    document.body,
  );
}
