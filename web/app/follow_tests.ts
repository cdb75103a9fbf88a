// What tests need comes once the project has a test: without one nothing is loaded for them.

import type { EditorView } from '@codemirror/view';
import type { ComponentType } from 'react';
import { deskFor } from '../core/desk';
import { Emitter } from '../core/emitter';
import { isTest } from '../core/paths';
import { retried } from '../core/retry';
import type { Studio } from '../core/studio';
import type { Doc } from '../protocol/messages';

/** What tests add above and into the view of a text; null until they are there. */
export const textPartOf = deskFor(() => ({
  changed: new Emitter<void>(),
  part: null as ComponentType<{ doc: Doc; view: EditorView | null }> | null,
}));

export function followTests(studio: Studio): void {
  let loads = false;
  studio.topics.subscribe('files', {}, () => {
    if (loads || !studio.topics.get('files', {})?.files.some(({ path }) => isTest(path))) return;
    loads = true;
    retried(() => import('./views/tests/test_parts')).then(
      ({ testCommands, TestParts }) => {
        studio.registry.add(testCommands(studio));
        const text = textPartOf(studio);
        text.part = TestParts;
        text.changed.emit();
      },
      (problem: unknown) => studio.tell(problem),
    );
  });
}
