import type { EditorView } from '@codemirror/view';
import { useState } from 'react';
import type { Doc } from '../../../protocol/messages';
import { toast } from '../../../core/window_state';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { text } from '../../text';
import { placeOf } from './places';

const words = text.editor;

export function RenameForm({ doc, view, onEnd }: { doc: Doc; view: EditorView; onEnd(): void }) {
  const studio = useStudio();
  const head = () => view.state.selection.main.head;
  const [name, setName] = useState(() => wordAt(view, head()));
  const [why, setWhy] = useState('');
  const rename = async () => {
    const { good, why: reason } = await studio.send('script.format_name', { name });
    if (!good) return setWhy(reason ?? '');
    const seen = await studio.documents.seen();
    // Others may have moved it meanwhile: where it is in the text that was seen.
    const at = placeOf(view.state.doc, head());
    const { places, changed } = await studio.send('script.rename', { doc, at, to: name, seen });
    toast(studio.window, 'ok', words.renamed(places, changed.length));
    onEnd();
  };
  return (
    <form
      className="form form--line"
      onSubmit={(event) => (
        event.preventDefault(),
        void rename().catch((problem: unknown) => (studio.tell(problem), onEnd()))
      )}
    >
      <label>
        {words.renameTo}
        <input
          className="field"
          autoFocus
          value={name}
          spellCheck={false}
          aria-invalid={why !== ''}
          onFocus={(event) => event.target.select()}
          onChange={(event) => setName(event.target.value)}
        />
        {why ? <span className="why">{why}</span> : null}
      </label>
      <Button type="submit">{text.tree.rename}</Button>
    </form>
  );
}

function wordAt(view: EditorView, at: number): string {
  const line = view.state.doc.lineAt(at);
  const before = /[\p{L}\p{N}_.]*$/u.exec(line.text.slice(0, at - line.from))?.[0] ?? '';
  const after = /^[\p{L}\p{N}_.]*/u.exec(line.text.slice(at - line.from))?.[0] ?? '';
  return before + after;
}
