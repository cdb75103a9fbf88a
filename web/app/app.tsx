import { MantineProvider } from '@mantine/core';
import { Suspense } from 'react';
import { late } from './parts/late';
import { useFleetShown, useLink, useTopic } from './hooks';
import { Overlay } from './overlay/overlay';
import { StatusBar } from './overlay/status_bar';
import { Toasts } from './overlay/toasts';
import { TopBar } from './topbar/topbar';
import { Notices } from './topbar/notices';
import { RobotLife } from './robot_life';
import { Tips } from './overlay/tips';
import { usePhone } from './phone/use_phone';
import { useKeys, useTheme, WindowLife } from './window_life';
import { text } from './text';

const Dock = late(async () => ({ default: (await import('./dock/dock')).Dock }));
const StartScreen = late(() => import('./start/start_screen'));
const FleetPage = late(() => import('./views/fleet/fleet_page'));
const Phone = late(async () => ({ default: (await import('./phone/phone')).Phone }));

/** The whole window. */
export function App() {
  const theme = useTheme();
  const isPhone = usePhone();
  const isFleet = useFleetShown();
  useKeys();
  return (
    <MantineProvider
      forceColorScheme={theme}
      withCssVariables={false}
      withGlobalClasses={false}
      withStaticClasses={false}
    >
      {/* First, as it chooses the layout of a project that is opened. */}
      <WindowLife />
      {isPhone && !isFleet ? (
        <Suspense fallback={null}>
          <Phone />
        </Suspense>
      ) : (
        <Desk />
      )}
      <RobotLife />
      <Overlay />
      <Toasts />
      <Tips />
    </MantineProvider>
  );
}

/** Panels beside each other. */
function Desk() {
  return (
    <div className="app">
      <TopBar />
      <Notices />
      <div className="app__main">
        <Suspense fallback={<p className="placeholder placeholder--late">{text.editor.opening}</p>}>
          <Main />
        </Suspense>
      </div>
      <StatusBar />
    </div>
  );
}

function Main() {
  const link = useLink();
  const studio = useTopic('studio', {});
  const isFleet = useFleetShown();
  if (!studio)
    return link.state === 'refused' ? null : <p className="placeholder">{text.link.connecting}</p>;
  if (isFleet) return <FleetPage />;
  // Another project is another window: nothing of the one before is left over.
  return studio.project ? <Dock key={studio.project.folder} /> : <StartScreen />;
}
