import type { Command } from '../../core/registry';
import { useCommands } from '../hooks';
import { Kbd } from './kbd';

/** The keys of all commands, by group: made from the registry, so it cannot be wrong. */
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
