import { MergeView } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { text } from '../../text';

/** Two texts side by side, what differs marked. */
export default function Compare({ mine, theirs }: { mine: string; theirs: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!host.current) return;
    const extensions = (label: string) => [
      lineNumbers(),
      EditorState.readOnly.of(true),
      EditorView.contentAttributes.of({ 'aria-label': label }),
    ];
    const view = new MergeView({
      parent: host.current,
      a: { doc: mine, extensions: extensions(text.editor.mine) },
      b: { doc: theirs, extensions: extensions(text.editor.theirs) },
      collapseUnchanged: {},
    });
    return () => view.destroy();
  }, [mine, theirs]);
  return <div className="compare" ref={host} />;
}
