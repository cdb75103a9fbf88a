// What belongs to one open file, put together. Loaded when the first file is opened.

import { JsonFile } from './json_file';
import { FileSync, type Opened } from './sync';
import { TextSession } from './text_session';
import type { DocLink } from './wire';

export interface OpenDocument {
  session: TextSession;
  sync: FileSync;
  language: string;
  /** As the value of a JSON file; one for all views. */
  file(): JsonFile;
  /** What an editor wants to find again when it is shown next. */
  kept: unknown;
}

export interface OpenOptions {
  link: DocLink;
  name: () => string;
  /** See FileSync. */
  isAsked: (by: string) => boolean;
  now: () => number;
}

export function openDocument(
  opened: Opened & { text: string; language: string },
  { link, name, isAsked, now }: OpenOptions,
): OpenDocument {
  const session = new TextSession(opened.text, opened.language);
  let file: JsonFile | null = null;
  return {
    session,
    sync: new FileSync(session, opened, link, name, isAsked),
    language: opened.language,
    file: () => (file ??= new JsonFile(session, now)),
    kept: null,
  };
}
