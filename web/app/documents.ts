// Documents of the project as the window shows them: kind, name, what opens with a layout.

import type { Doc, FileEntry } from '../protocol/messages';
import type { DocumentKind } from '../core/layouts';
import { partOf, shownName } from '../core/paths';
import { isPlan, planMeant } from '../core/run_choice';
import type { Studio } from '../core/studio';

export function kindOf(doc: Doc): DocumentKind {
  const { file, part } = partOf(doc);
  if (part > 0) return 'script';
  if (file.endsWith('.plan.json')) return 'plan';
  return file.endsWith('.world.json') ? 'world' : 'other';
}

export function fileKindOf(doc: Doc): FileEntry['kind'] {
  const { file } = partOf(doc);
  if (file.endsWith('.aesl')) return 'script';
  if (file.endsWith('.toolbox.json')) return 'toolbox';
  if (file.endsWith('vagus.json')) return 'project';
  const kind = kindOf(doc);
  return kind === 'other' ? 'text' : kind;
}

export function documentsOf(studio: Studio, kind: DocumentKind): Doc[] {
  const project = studio.topics.get('studio', {})?.project;
  switch (kind) {
    case 'plan':
      return planOf(studio);
    case 'world':
      return project?.world ? [project.world] : [];
    case 'script':
      return scriptsOf(studio, project?.scripts ?? []);
    case 'other':
      return [];
  }
}

/** The plan that a layout opens: that which runs, was shown or ran last, that of vagus.json, any. */
function planOf(studio: Studio): Doc[] {
  const exists = (doc: Doc) => documentExists(studio, doc);
  const { doc } = studio.window.getState();
  const plan = studio.topics.get('plan', {});
  const runs = plan?.state === 'running' || plan?.state === 'paused' ? plan.doc : undefined;
  const kept = studio.topics.get('state', {})?.values;
  const project = studio.topics.get('studio', {})?.project?.plan;
  const meant = planMeant({ doc: runs ?? doc, kept, project, exists });
  if (meant !== undefined) return [meant];
  const files = studio.topics.get('files', {})?.files ?? [];
  return files.flatMap(({ path }) => (isPlan(path) ? path : [])).slice(0, 1);
}

/** Those of the files that the project names; all if it names none. */
function scriptsOf(studio: Studio, named: readonly string[]): Doc[] {
  const parts = studio.topics.get('scripts', {})?.parts ?? [];
  const own = parts.filter((part) => named.includes(part.file));
  return (own.length > 0 ? own : parts).map((part) => part.doc);
}

export function documentExists(studio: Studio, doc: Doc): boolean {
  const { file, part } = partOf(doc);
  if (part > 0)
    return (studio.topics.get('scripts', {})?.parts ?? []).some((one) => one.doc === doc);
  return (studio.topics.get('files', {})?.files ?? []).some((one) => one.path === file);
}

/** What a file opens: the scripts of its nodes, or itself. */
export function documentsIn(studio: Studio, path: string): Doc[] {
  const parts = (studio.topics.get('scripts', {})?.parts ?? []).filter(
    (part) => part.file === path,
  );
  return parts.length > 0 ? parts.map((part) => part.doc) : [path];
}

/** With what a tab says behind the name. */
export function tabNameOf(studio: Studio, doc: Doc): string {
  return `${nameOf(studio, doc)} ${secondNameOf(studio, doc)}`.trim();
}

/** The number of a script's node; its file where other scripts are for the same node. */
export function secondNameOf(studio: Studio, doc: Doc): string {
  const parts = studio.topics.get('scripts', {})?.parts ?? [];
  const own = parts.find((one) => one.doc === doc);
  if (!own?.name) return '';
  const shared = parts.some((one) => one !== own && one.name === own.name && one.node === own.node);
  if (shared) return shownName(own.file);
  return own.node > 0 ? String(own.node) : '';
}

export function nameOf(studio: Studio, doc: Doc): string {
  const part = studio.topics.get('scripts', {})?.parts.find((one) => one.doc === doc);
  return part?.name || shownName(partOf(doc).file);
}
