// What is seen of plans that somebody has worked on: which place of the drawing, how large.

import type { Doc } from '../../protocol/messages';

export interface View {
  x: number;
  y: number;
  zoom: number;
}

export const kViewsMax = 100;

export class Views {
  /** The one that was kept last at the end. */
  private readonly views: Map<Doc, View>;

  /** From the text of others; null or anything else: none is known. */
  constructor(text: string | null) {
    this.views = new Map(read(text));
  }

  get(doc: Doc): View | undefined {
    return this.views.get(doc);
  }

  keep(doc: Doc, view: View): void {
    this.views.delete(doc);
    this.views.set(doc, view);
    for (const oldest of this.views.keys()) {
      if (this.views.size <= kViewsMax) break;
      this.views.delete(oldest);
    }
  }

  text(): string {
    return JSON.stringify([...this.views]);
  }
}

function read(text: string | null): [Doc, View][] {
  try {
    const list: unknown = JSON.parse(text ?? '[]');
    return Array.isArray(list) ? list.filter(isEntry) : [];
  } catch {
    return [];
  }
}

function isEntry(entry: unknown): entry is [Doc, View] {
  if (!Array.isArray(entry)) return false;
  const [doc, view] = entry as unknown[];
  return typeof doc === 'string' && isView(view);
}

function isView(view: unknown): view is View {
  if (typeof view !== 'object' || view === null) return false;
  const { x, y, zoom } = view as Partial<Record<keyof View, unknown>>;
  return [x, y, zoom].every((one) => Number.isFinite(one)) && Number(zoom) > 0;
}
