import type { EditorView } from '@codemirror/view';
import { isTest } from '../../../core/paths';
import type { Doc } from '../../../protocol/messages';
import { ScriptCoverage } from './script_coverage';
import { TestBar } from './test_bar';
import '../../look/tests.css';

export { testCommands } from '../../commands/test_commands';

/** Above a text: of a test, what runs it; of a script, what the tests took of it. */
export function TestParts({ doc, view }: { doc: Doc; view: EditorView | null }) {
  if (isTest(doc)) return <TestBar doc={doc} view={view} />;
  return doc.includes('.aesl') ? <ScriptCoverage doc={doc} view={view} /> : null;
}
