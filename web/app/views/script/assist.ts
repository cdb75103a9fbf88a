// What the compiler knows, where it is wanted: completion, help under the pointer, definitions.

import {
  acceptCompletion,
  autocompletion,
  closeCompletion,
  completionStatus,
  selectedCompletion,
  type Completion,
  type CompletionContext,
  type CompletionResult,
} from '@codemirror/autocomplete';
import { Prec, StateField, type Extension } from '@codemirror/state';
import { EditorView, hoverTooltip, keymap, type Tooltip } from '@codemirror/view';
import type { Commands, Doc, Suggestion } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { findingsAt } from './findings';
import { offsetOf, placeOf } from './places';

export function assist(studio: Studio, doc: Doc, onDefinition: (at: number) => void): Extension {
  return [
    Prec.highest(
      keymap.of([
        { key: 'Enter', run: enterEndsLine },
        { key: 'Tab', run: acceptCompletion },
      ]),
    ),
    offeredSince,
    autocompletion({
      override: [(context) => complete(studio, doc, context)],
      icons: true,
      maxRenderedOptions: 80,
      activateOnTypingDelay: 50,
      // Tab takes what is shown, at once; Enter has a rule of its own below.
      interactionDelay: 0,
    }),
    hoverTooltip((view, at) => hover(studio, doc, view, at), { hoverTime: 350 }),
    EditorView.domEventHandlers({
      mousedown(event, view) {
        if (!(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
        const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
        if (at === null) return false;
        onDefinition(at);
        return true;
      },
    }),
  ];
}

/** Nobody has seen a list that is there for less. */
const kSeenAfterMs = 75;

/** When the list came up; 0 while there is none. */
const offeredSince = StateField.define<number>({
  create: () => 0,
  update: (since, { state }) =>
    completionStatus(state) === 'active' ? since || performance.now() : 0,
});

/**
 * A word that is typed in full is not completed, nor one whose list nobody has seen: Enter then ends
 * the line, as everywhere.
 */
function enterEndsLine(view: EditorView): boolean {
  const chosen = selectedCompletion(view.state)?.label;
  if (chosen === undefined) return false;
  const { head } = view.state.selection.main;
  const typed = view.state.sliceDoc(Math.max(0, head - chosen.length), head);
  const unseen = performance.now() - view.state.field(offeredSince) < kSeenAfterMs;
  if (typed === chosen || unseen) closeCompletion(view);
  return false;
}

async function complete(
  studio: Studio,
  doc: Doc,
  context: CompletionContext,
): Promise<CompletionResult | null> {
  const word = context.matchBefore(/[\p{L}\p{N}_.]+/u);
  // A number is no beginning of a name.
  if (!context.explicit && !/^[\p{L}_]/u.test(word?.text ?? '')) return null;
  const at = placeOf(context.state.doc, context.pos);
  const answer = await studio.documents
    .sent(doc)
    .then(() => studio.send('script.complete', { doc, at }))
    .catch(() => null);
  if (!answer || context.aborted || answer.items.length === 0) return null;
  const keywords = new Set(answer.items.filter(isKeyword).map((one) => one.label));
  // Nothing is left to complete of a keyword that is there in full: the list goes.
  const isWhole = (typed: string) => !context.explicit && keywords.has(typed);
  if (isWhole(word?.text ?? '')) return null;
  return {
    from: offsetOf(context.state.doc, answer.from),
    options: answer.items.map(optionOf),
    validFor: (typed) => /^[\p{L}\p{N}_.]*$/u.test(typed) && !isWhole(typed),
  };
}

function isKeyword(item: Suggestion): boolean {
  return item.kind === 'keyword';
}

function optionOf(item: Suggestion): Completion {
  const { label, kind, detail, help, insert } = item;
  return { label, detail, type: kind, apply: insert || label, ...(help ? { info: help } : {}) };
}

async function hover(
  studio: Studio,
  doc: Doc,
  view: EditorView,
  at: number,
): Promise<Tooltip | null> {
  const findings = findingsAt(view.state, at);
  const place = placeOf(view.state.doc, at);
  const answer = await studio.send('script.hover', { doc, at: place }).catch(() => null);
  if (findings.length === 0 && !answer?.found) return null;
  const pos = answer?.at ? offsetOf(view.state.doc, answer.at) : at;
  return {
    pos,
    above: true,
    create: () => ({
      dom: hoverView(
        findings.map((one) => one.what),
        answer,
      ),
    }),
  };
}

function hoverView(
  sentences: string[],
  answer: Commands['script.hover']['out'] | null,
): HTMLElement {
  const box = document.createElement('div');
  box.className = 'hover';
  for (const sentence of sentences) box.append(line('hover__finding', sentence));
  if (answer?.found && answer.title) box.append(line('hover__title', answer.title));
  if (answer?.found && answer.help) box.append(line('hover__help', answer.help));
  return box;
}

function line(name: string, words: string): HTMLElement {
  const part = document.createElement('div');
  part.className = name;
  part.textContent = words;
  return part;
}
