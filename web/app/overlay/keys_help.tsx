import { IconX } from '@tabler/icons-react';
import type { Command } from '../../core/registry';
import { useCommands } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { Kbd } from '../parts/kbd';
import { text } from '../text';
import { OverlayFrame, useCloseOverlay } from './overlay_frame';

/** The keys of all commands, by group: made from the registry, so it cannot be wrong. */
export default function KeysHelp() {
  const close = useCloseOverlay();
  return (
    <OverlayFrame label={text.overlay.keys}>
      <div className="sheet">
        <div className="sheet__head">
          <h2>{text.overlay.keys}</h2>
          <Button
            autoFocus
            kind="plain"
            tip={text.overlay.close}
            icon={<IconX size={16} stroke={kStroke} />}
            onClick={close}
          />
        </div>
        <KeysList />
      </div>
    </OverlayFrame>
  );
}

export function KeysList() {
  const groups = new Map<string, Command[]>();
  for (const command of useCommands()) {
    if (command.keys) groups.set(command.group, [command, ...(groups.get(command.group) ?? [])]);
  }
  return (
    <div className="keys">
      {[...groups].map(([group, commands]) => (
        <section key={group}>
          <h3>{group}</h3>
          <ul>
            {commands.map((command) => (
              <li key={command.id}>
                {command.title}
                {command.keys?.map((keys) => (
                  <Kbd key={keys} keys={keys} />
                ))}
              </li>
            ))}
          </ul>
        </section>
      ))}
    </div>
  );
}
