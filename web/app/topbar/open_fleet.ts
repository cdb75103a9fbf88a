import type { FleetAddress } from '../../core/settings';
import type { Studio } from '../../core/studio';
import { update } from '../../core/window_state';
import { whyOf } from '../../core/why';

/** Looks at a fleet, and keeps its address for the next time. '' or why it cannot be. */
export async function openFleet(studio: Studio, address: FleetAddress): Promise<string> {
  const { target, ca, login } = address;
  try {
    await studio.send('fleet.open', { target, ...(ca && { ca }), ...(login && { login }) });
  } catch (problem) {
    return whyOf(problem);
  }
  studio.order('settings.put', { key: 'fleet', value: { target, ca, login } });
  update(studio.window, (draft) => void (draft.view = 'fleet'));
  return '';
}
