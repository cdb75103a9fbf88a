// What is seen of each plan, as long as the tab of the browser lives: another layout shows the same, and so does the page
// after a reload.

import { deskFor } from '../../../../core/desk';
import { Views } from '../../../../core/plan/views';
import type { Studio } from '../../../../core/studio';

const kKey = 'vagus.views';

const views: (studio: Studio) => Map<string, Views> = deskFor(() => new Map<string, Views>());

/** Those of the project that is open. */
export function keptViews(studio: Studio): Views {
  const folder = studio.topics.get('studio', {})?.project?.folder ?? '';
  const known = views(studio).get(folder);
  if (known) return known;
  const key = `${kKey} ${folder}`;
  const made = new Views(sessionStorage.getItem(key));
  views(studio).set(folder, made);
  addEventListener('pagehide', () => sessionStorage.setItem(key, made.text()));
  return made;
}
