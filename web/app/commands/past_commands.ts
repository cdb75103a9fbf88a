import { kPastStep } from '../../core/past';
import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { revealDoc, revealPanel, toast } from '../../core/window_state';
import { takeFocus } from '../parts/take_focus';
import { text } from '../text';
import { askDecided, askWhy } from './ask_why';
import { shownEditor } from './editor_handles';
import { canLog, logAt } from './log_values';
import { drives } from './looks';

/** What somebody saw happen lies about so far back. */
const kPastSeconds = 2;
const titles = text.commands;
const group = text.groups.past;

/** Looking back: the cursor, step by step, and now again. Its keys are those of the timeline. */
export function pastCommands(studio: Studio): Command[] {
  const { past } = studio;
  const looksBack = () => past.at !== null;
  const known = () => past.end > past.start;
  const simulated = () => studio.topics.get('history', {})?.kind === 'simulated';
  const leadsOn = () => drives(studio) && looksBack() && past.trace === null && simulated();
  const hasPlan = () => studio.topics.get('plan', {})?.state !== 'none';
  const within = 'past';
  const stepped = (forward: boolean) => () => past.stepOfPlan(forward);
  return [
    {
      id: 'past.back',
      title: titles['past.back'],
      group,
      keys: ['Escape'],
      enabled: looksBack,
      run: () => past.back(),
    },
    {
      id: 'past.earlier',
      title: titles['past.earlier'],
      group,
      keys: ['ArrowLeft'],
      within,
      enabled: known,
      run: () => past.step(-kPastStep),
    },
    {
      id: 'past.later',
      title: titles['past.later'],
      group,
      keys: ['ArrowRight'],
      within,
      enabled: looksBack,
      run: () => past.step(kPastStep),
    },
    {
      id: 'past.stepBefore',
      title: titles['past.stepBefore'],
      group,
      keys: ['Shift+ArrowLeft'],
      within,
      enabled: known,
      run: stepped(false),
    },
    {
      id: 'past.stepAfter',
      title: titles['past.stepAfter'],
      group,
      keys: ['Shift+ArrowRight'],
      within,
      enabled: looksBack,
      run: stepped(true),
    },
    {
      id: 'past.lookBack',
      title: titles['past.lookBack'],
      group,
      // From anywhere; the keys above only where time is looked at.
      keys: ['Alt+F10'],
      enabled: known,
      run: stepped(false),
    },
    {
      id: 'past.seconds',
      title: titles['past.seconds'],
      group,
      enabled: known,
      run: () => past.step(-kPastSeconds),
    },
    {
      id: 'past.runs',
      title: `${text.past.earlierRuns}…`,
      group,
      enabled: () => drives(studio) && studio.topics.get('studio', {})?.project !== undefined,
      run() {
        revealPanel(studio.window, 'timeline');
        takeFocus(() => {
          const button = document.querySelector<HTMLElement>('[data-earlier-runs]');
          button?.focus();
          button?.click();
          return button !== null;
        });
      },
    },
    {
      id: 'past.continue',
      title: titles['past.continue'],
      group,
      // What Run is now, while nobody looks back.
      keys: ['F5'],
      enabled: leadsOn,
      run: () => continueFrom(studio, false),
    },
    {
      id: 'past.stay',
      title: titles['past.stay'],
      group,
      enabled: leadsOn,
      run: () => continueFrom(studio, true),
    },
    {
      id: 'past.why',
      title: titles['past.why'],
      group,
      enabled: known,
      run: () => askWhy(studio, 'end'),
    },
    {
      id: 'past.decided',
      title: titles['past.decided'],
      group,
      enabled: () => drives(studio) && known() && simulated(),
      run: () => askDecided(studio),
    },
    {
      id: 'past.log',
      title: titles['past.log'],
      group,
      keys: ['Shift+F9'],
      enabled: () => canLog(studio) && scriptLine(studio) !== null,
      async run() {
        const at = scriptLine(studio);
        if (at) await logAt(studio, { is: 'line', ...at });
      },
    },
    {
      id: 'test.keep',
      title: titles['test.keep'],
      group,
      enabled: () => drives(studio) && simulated() && (hasPlan() || known()),
      async run() {
        const { path, differs } = await studio.send('test.keep', {});
        revealDoc(studio.window, path, null);
        if (differs) toast(studio.window, 'warning', text.past.testedAgain(path));
        else toast(studio.window, 'ok', text.past.tested(path));
      },
    },
    {
      id: 'trace.save',
      title: titles['trace.save'],
      group,
      enabled: () => drives(studio) && hasPlan(),
      async run() {
        const { path } = await studio.send('history.save', {});
        toast(studio.window, 'ok', text.past.saved(path));
      },
    },
  ];
}

/** Where the caret is; null: in no script. */
function scriptLine(studio: Studio): { doc: string; line: number } | null {
  const { doc } = studio.window.getState();
  const line = doc?.includes('#') ? shownEditor(studio)?.line() : undefined;
  return doc === null || line === undefined ? null : { doc, line };
}

/** The run begins again, comes to that instant, and goes another way from there. */
async function continueFrom(studio: Studio, paused: boolean): Promise<void> {
  const { at: t, plan, settings } = studio.past;
  if (t === null) return;
  const set = settings.of(plan?.levels ?? []);
  await studio.send('run.continue', { t, paused, ...(set.length === 0 ? {} : { set }) });
}

/** Runs a recorded run again: its timeline is that of the run. One that cannot be is shown as it was recorded. */
export async function openRecording(studio: Studio, path: string): Promise<void> {
  try {
    const { again, why } = onRobot(studio)
      ? { again: false, why: text.past.onRobot(path) }
      : await studio.send('recording.open', { path });
    if (again === false) {
      await openTrace(studio, path);
      toast(studio.window, 'ok', text.past.asRecorded(why ?? path));
    }
    revealPanel(studio.window, 'timeline');
  } catch (problem) {
    studio.tell(problem);
  }
}

const onRobot = (studio: Studio) => studio.topics.get('robot', {})?.kind === 'bus';

/** Shows a run that is kept as a file: its plan at each instant, without a run. */
export async function openTrace(studio: Studio, path: string): Promise<void> {
  try {
    const { plan, refused, scene } = await studio.past.openTrace(path);
    if (scene !== undefined) revealPanel(studio.window, 'world');
    revealPanel(studio.window, 'timeline');
    if (!plan) toast(studio.window, 'warning', text.past.noPlan(path));
    if (refused > 0) toast(studio.window, 'warning', text.past.refused(path, refused));
  } catch (problem) {
    studio.tell(problem);
  }
}
