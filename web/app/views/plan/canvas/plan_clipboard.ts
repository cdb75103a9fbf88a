// Copy, cut and paste of elements. The keys arrive as events of the browser, which needs no
// permission for them; commands of the palette ask the clipboard, where the browser has one to ask.

import { useMemo } from 'react';
import { parsePart, partText } from '../../../../core/plan/part';
import type { Studio } from '../../../../core/studio';
import { toast } from '../../../../core/window_state';
import { drawWords as words } from '../words';
import type { ShownPlan } from '../plan_desk';

/** The text of what is chosen; null: nothing that can be copied. */
export function copied({ board }: ShownPlan): string | null {
  const part = board.part();
  return part && partText(part);
}

export function cut(plan: ShownPlan): void {
  plan.focus(plan.board.removeChosen());
}

export function pasteText(studio: Studio, plan: ShownPlan, pasted: string): void {
  const part = parsePart(pasted);
  if (!part) return toast(studio.window, 'note', words.noPart);
  plan.board.paste(part, plan.middle());
  const { selected } = plan.board;
  if (selected !== null) plan.focus(selected);
}

export async function copyByCommand(plan: ShownPlan): Promise<void> {
  const part = copied(plan);
  if (part !== null) await navigator.clipboard.writeText(part);
}

export async function pasteByCommand(studio: Studio, plan: ShownPlan): Promise<void> {
  pasteText(studio, plan, await navigator.clipboard.readText());
}

/** Pages from an open address without TLS have none. */
export const hasClipboard = () => 'clipboard' in navigator;

const isText = (target: EventTarget) =>
  target instanceof HTMLElement && target.closest('input, textarea, [contenteditable]') !== null;

export function useClipboard(studio: Studio, plan: ShownPlan, drives: boolean) {
  return useMemo(() => {
    const put = (event: React.ClipboardEvent): boolean => {
      const part = isText(event.target) ? null : copied(plan);
      if (part === null) return false;
      event.clipboardData.setData('text/plain', part);
      event.preventDefault();
      return true;
    };
    return {
      onCopy: (event: React.ClipboardEvent) => void put(event),
      onCut(event: React.ClipboardEvent) {
        if (drives && put(event)) cut(plan);
      },
      onPaste(event: React.ClipboardEvent) {
        if (!drives || isText(event.target)) return;
        event.preventDefault();
        pasteText(studio, plan, event.clipboardData.getData('text/plain'));
      },
    };
  }, [studio, plan, drives]);
}
