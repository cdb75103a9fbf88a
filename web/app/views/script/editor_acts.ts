// What is done with a place of a script.

import type { Doc, Place } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { revealDoc, revealPanel, toast, update } from '../../../core/window_state';
import { EditorView } from '@codemirror/view';
import { takeFocus } from '../../parts/take_focus';
import { text } from '../../text';
import { placeOf } from './places';
import { shownView } from './views';

export function toggleBreakpoint(studio: Studio, doc: Doc, line: number): void {
  const there = studio.topics
    .get('breakpoints', {})
    ?.breakpoints.some((one) => one.doc === doc && one.line === line);
  if (there) studio.order('break.clear', { doc, line });
  else studio.order('break.set', { doc, line });
}

export function editBreakpoint(studio: Studio, doc: Doc, line: number): void {
  update(studio.window, (draft) => void (draft.form = { doc, is: 'breakpoint', line }));
}

export async function goToDefinition(studio: Studio, doc: Doc, at: number): Promise<void> {
  const place = here(studio, doc, at);
  if (!place) return;
  const { spots } = await studio.send('script.definition', { doc, at: place });
  const spot = spots[0];
  if (spot) revealDoc(studio.window, spot.doc, spot.at);
  else toast(studio.window, 'note', text.editor.noDefinition);
}

export async function findReferences(studio: Studio, doc: Doc, at: number): Promise<void> {
  const place = here(studio, doc, at);
  if (!place) return;
  await studio.documents.flushAll();
  const references = await studio.send('script.references', { doc, at: place });
  update(studio.window, (draft) => void (draft.references = references));
  revealPanel(studio.window, 'references');
}

function here(studio: Studio, doc: Doc, at: number): Place | null {
  const view = shownView(studio, doc);
  return view ? placeOf(view.state.doc, at) : null;
}

/** Puts the caret at an offset, in the middle of what is seen if it was out of sight. */
export function goTo(view: EditorView, offset: number, focus: boolean): void {
  const show = () =>
    view.dispatch({
      selection: { anchor: offset },
      effects: EditorView.scrollIntoView(offset, { y: 'center' }),
    });
  show();
  if (focus) takeFocus(() => (view.focus(), view.hasFocus), show);
}
