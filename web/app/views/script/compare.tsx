import { MergeView } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef, useState } from 'react';
import type { Doc } from '../../../protocol/messages';
import { useStudio } from '../../hooks';
import { text } from '../../text';
import '../../look/editor.css';

interface Shown {
  doc: Doc;
  version: number;
  /** Which file is on disk: `disk_hash` of the document. */
  disk: string | undefined;
}

/** The text from here and the one on disk side by side, what differs marked. */
export default function Compare({ doc, version, disk }: Shown) {
  const studio = useStudio();
  const [texts, setTexts] = useState<{ mine: string; theirs: string } | null>(null);
  useEffect(() => {
    let gone = false;
    const held = studio.documents.acquire(doc);
    Promise.all([held.opened, studio.send('doc.disk', { doc })]).then(
      ([{ session }, { text: theirs }]) => gone || setTexts({ mine: session.text, theirs }),
      (problem: unknown) => studio.tell(problem),
    );
    return () => {
      gone = true;
      held.release();
    };
  }, [studio, doc, version, disk]);
  return texts ? <SideBySide {...texts} /> : null;
}

function SideBySide({ mine, theirs }: { mine: string; theirs: string }) {
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
