import { Suspense, useState } from 'react';
import { whatRuns } from '../../core/run_choice';
import { usePart, useTopic } from '../hooks';
import { late } from '../parts/late';
import { Logo } from '../parts/icons';
import { text } from '../text';
import { Notices } from '../topbar/notices';
import { PhoneRun } from './phone_run';
import { PhoneTabs, type PhoneTab } from './phone_tabs';
import '../look/phone.css';
import { phoneWords } from './words';

const views = {
  plan: late(() => import('./phone_plan')),
  world: late(() => import('../panels/world_panel')),
  variables: late(() => import('../panels/variables/variables_panel')),
  console: late(() => import('../panels/console_panel')),
};

/** The window on a telephone: to watch, to stop and to start. Stop stays in sight whatever is shown. */
export function Phone() {
  const project = useTopic('studio', {})?.project;
  return (
    <div className="phone">
      <header className="phone__top" data-region="top" aria-label={text.regions.top}>
        <div className="phone__line">
          <Logo />
          <h1 className="ellipsis grow">{project?.name ?? text.name}</h1>
          <PhoneClock />
        </div>
        <PhoneRun />
      </header>
      <Notices />
      {project ? (
        <PhoneMain key={project.folder} hasPlan={project.plan !== undefined} />
      ) : (
        <p className="placeholder">{phoneWords.noProject}</p>
      )}
    </div>
  );
}

function PhoneClock() {
  const state = usePart('clock', {}, (is) => is?.state ?? 'none');
  const t = usePart('clock', {}, (is) => is?.t ?? 0);
  const isBus = usePart('robot', {}, (is) => is?.kind === 'bus');
  const nodes = usePart('robot', {}, (is) => whatRuns(is, undefined));
  // On a bus there is a clock only while a plan runs.
  if (isBus && state === 'none')
    return nodes === '' ? null : (
      <span className="phone__clock clock--running ellipsis" title={nodes}>
        {text.run.running}: {nodes}
      </span>
    );
  return (
    <span className={`phone__clock num clock--${state}`}>
      {state === 'none' && t === 0 ? text.run.ready : text.run[state]} · {t.toFixed(1)} s
    </span>
  );
}

function PhoneMain({ hasPlan }: { hasPlan: boolean }) {
  const [tab, setTab] = useState<PhoneTab>(hasPlan ? 'plan' : 'world');
  const View = views[tab];
  return (
    <>
      <PhoneTabs chosen={tab} onChoose={setTab} />
      <main className="phone__main">
        <div
          className="phone__view"
          role="tabpanel"
          id="phone-view"
          aria-label={phoneWords.tabs[tab]}
        >
          <Suspense fallback={null}>
            <View />
          </Suspense>
        </div>
      </main>
    </>
  );
}
