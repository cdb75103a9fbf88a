// Fields in which something is typed that does not count yet. Save, Run, Check and leaving take it
// first: see Documents.flushAll.

import type { Doc } from '../../protocol/messages';
import { Emitter } from '../emitter';

export interface TypedField {
  /** The file that it changes; null: none. */
  readonly doc: Doc | null;
  /** Takes what is typed; false: it is refused, and stays in its field. */
  settle(): boolean;
}

export class Fields {
  readonly changed = new Emitter<void>();
  private readonly typed = new Set<TypedField>();

  /** As long as something is typed in it. */
  add(field: TypedField): () => void {
    this.typed.add(field);
    this.changed.emit();
    return () => {
      this.typed.delete(field);
      this.changed.emit();
    };
  }

  get isTyped(): boolean {
    return this.typed.size > 0;
  }

  isTypedFor(doc: Doc): boolean {
    return [...this.typed].some((field) => field.doc === doc);
  }

  /** True if all was taken. */
  settle(): boolean {
    return [...this.typed].map((field) => field.settle()).every((taken) => taken);
  }
}
