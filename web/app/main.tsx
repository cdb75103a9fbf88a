// Starts the page: who are we, where is the server, what is shown.

import '@mantine/core/styles/default-css-variables.css';
import '@mantine/core/styles/UnstyledButton.css';
import '@mantine/core/styles/Popover.css';
import '@mantine/core/styles/Menu.css';
import 'flexlayout-react/style/light.css';
import './look/fonts.css';
import './look/tokens.css';
import './look/present.css';
import './look/base.css';
import './look/controls.css';
import './look/frame.css';
import './look/dock.css';
import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { identityOf, keepToken, keptToken, tokenIn } from '../core/identity';
import { browserWorld } from '../core/socket';
import { Studio } from '../core/studio';
import { App } from './app';
import { editCommands } from './commands/edit_commands';
import { fileCommands } from './commands/file_commands';
import { panels } from './dock/panels';
import { followAlways } from './commands/looks';
import { planCommands } from './views/plan/plan_commands';
import { problemCommands } from './commands/problem_commands';
import { robotCommands } from './commands/robot_commands';
import { nodeCommands, runCommands } from './commands/run_commands';
import { pastCommands } from './commands/past_commands';
import { viewCommands } from './commands/view_commands';
import { refuse, whyNot } from './commands/why_not';
import { worldCommands } from './views/world/world_commands';
import { followRecorded } from './follow_recorded';
import { followTests } from './follow_tests';
import { StudioContext } from './hooks';
import { PageGuard } from './page_guard';
import { keptTheme } from './window_life';
import { onApple } from './parts/keys_shown';

function start(): void {
  const theme = keptTheme();
  const system = matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark';
  document.documentElement.dataset['theme'] = theme === 'system' ? system : theme;
  const address = new URL('live', location.href);
  address.protocol = address.protocol.replace('http', 'ws');
  address.hash = '';
  const identity = identityOf(sessionStorage, () =>
    crypto.getRandomValues(new Uint32Array(4)).join('-'),
  );
  const studio = new Studio(browserWorld(address.href), identity, takeToken(), () => Date.now());
  studio.registry.isApple = onApple;
  for (const make of [
    editCommands,
    fileCommands,
    problemCommands,
    (one: Studio) => viewCommands(one, panels),
    pastCommands,
    robotCommands,
    nodeCommands,
    runCommands,
    planCommands,
    worldCommands,
  ])
    studio.registry.add(make(studio));
  studio.registry.whyNot = (command) => whyNot(studio, command);
  studio.registry.refuse = (command, key) => refuse(studio, command, key);
  followAlways(studio);
  followTests(studio);
  followRecorded(studio);
  studio.connection.start();
  const root = document.getElementById('root');
  if (root)
    createRoot(root).render(
      <StrictMode>
        <StudioContext value={studio}>
          <PageGuard studio={studio}>
            <App />
          </PageGuard>
        </StudioContext>
      </StrictMode>,
    );
}

/** The token leaves the address bar at once; a reload of this tab still has it. */
function takeToken(): string {
  const given = tokenIn(location.hash);
  if (given) {
    keepToken(sessionStorage, given);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return given || keptToken(sessionStorage);
}

start();
