import type { About } from '../../core/asking';
import { kPlanNode, type Pick } from '../../core/picks';
import type { Studio } from '../../core/studio';
import type { Happening } from '../../protocol/messages';
import { revealPanel } from '../../core/window_state';

/** Asks it of the instant that is shown, and shows the answer. What it needs is loaded then. */
export async function askWhy(
  studio: Studio,
  about: About,
  name = '',
  robot?: string,
): Promise<void> {
  try {
    const { askingOf } = await import('../../core/asking');
    void askingOf(studio).ask({ about, name, t: studio.past.at, robot });
    revealPanel(studio.window, 'why');
  } catch (problem) {
    studio.tell(problem);
  }
}

/** The same of an event; in a recording of several robots, of the one on whose bus it was. */
export function askWhyEvent(studio: Studio, { name, source }: Happening): void {
  const robot = studio.past.trace?.robots.find(
    (one) => source === one || source.startsWith(`${one}/`),
  );
  void askWhy(studio, 'event', name, robot);
}

/** Shows where it is asked when something was decided. */
export async function askDecided(studio: Studio): Promise<void> {
  try {
    const { askingOf } = await import('../../core/asking');
    askingOf(studio).look('decided');
    revealPanel(studio.window, 'why');
  } catch (problem) {
    studio.tell(problem);
  }
}

/** The same of a variable of a node or the plan; of an array as a whole. */
export function askWhyOf(studio: Studio, { node, name }: Pick): void {
  const nodes = studio.topics.get('robot', {})?.nodes;
  const own = node === kPlanNode ? undefined : nodes?.find((one) => one.id === node)?.name;
  void askWhy(studio, 'variable', own === undefined ? name : `${own}.${name}`);
}

/** The key of a row that can be asked about. */
export const isWhyKey = ({ key, ctrlKey, altKey, metaKey }: React.KeyboardEvent): boolean =>
  key.toLowerCase() === 'w' && !ctrlKey && !altKey && !metaKey;
