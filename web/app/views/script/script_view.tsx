import type { Doc } from '../../../protocol/messages';
import { textPartOf } from '../../follow_tests';
import { useChanges, useStudio, useWindow } from '../../hooks';
import { Blank } from '../../parts/blank';
import { Button } from '../../parts/button';
import { text } from '../../text';
import { EditorForm } from './editor_form';
import { Listing } from './listing';
import { Meters } from './meters';
import { ScriptNotices } from './script_notices';
import { useEditor } from './use_editor';
import { useScriptData } from './use_script_data';
import '../../look/editor.css';

/** A text with what the compiler and the node know of it. */
export default function ScriptView({ doc, isScript }: { doc: Doc; isScript: boolean }) {
  const { host, view, failed, retry } = useEditor(doc);
  const listing = useWindow((state) => state.listing[doc] ?? false);
  useScriptData(doc, isScript, view);
  const more = textPartOf(useStudio());
  useChanges(more.changed);
  if (failed)
    return (
      <Blank title={text.editor.failed}>
        <p>{failed}</p>
        <Button onClick={retry}>{text.editor.again}</Button>
      </Blank>
    );
  return (
    <div className="script">
      <ScriptNotices doc={doc} isScript={isScript} />
      {more.part ? <more.part doc={doc} view={view} /> : null}
      <div className="script__main">
        <div className="script__editor" ref={host} />
        {isScript && listing ? <Listing doc={doc} /> : null}
        {view ? <EditorForm doc={doc} view={view} /> : null}
      </div>
      <Meters doc={doc} isScript={isScript} />
    </div>
  );
}
