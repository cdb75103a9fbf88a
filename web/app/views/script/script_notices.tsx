import { IconAlertOctagon, IconAlertTriangle } from '@tabler/icons-react';
import { Suspense, useState, type ReactNode } from 'react';
import { late } from '../../parts/late';
import type { Doc } from '../../../protocol/messages';
import { countsOf } from '../../../core/findings';
import { pausedLineOf } from '../../../core/run_state';
import { usePastTime } from '../../past_hooks';
import { useDocuments, useDrives, useStudio, useTopic } from '../../hooks';
import { timeOf } from '../../parts/time_of';
import { Button } from '../../parts/button';
import { RunFromHere } from '../run_from_here';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';

const words = text.editor;
/** Lines below each other are no JSON any more. */
const kTexts: readonly string[] = ['aesl', 'aesl-file', 'text'];
const Compare = late(() => import('./compare'));

/** Lines above a text: what runs is another one, the node has stopped, the file has changed. */
export function ScriptNotices({ doc, isScript }: { doc: Doc; isScript: boolean }) {
  return (
    <>
      {isScript ? <LoadedNotice doc={doc} /> : null}
      <DiskNotice doc={doc} />
    </>
  );
}

function LoadedNotice({ doc }: { doc: Doc }) {
  const { registry } = useStudio();
  const past = usePastTime();
  const node = useTopic('robot', {})?.nodes.find((one) => one.doc === doc);
  const { errors } = countsOf(useTopic('findings', {})?.findings ?? [], doc);
  if (node?.fault) return <Line error>{words.fault(node.fault, pausedLineOf(node))}</Line>;
  if (!node || node.program !== 'older' || node.state === 'gone') return null;
  // What a world has loaded by itself has no time.
  const time = node.loaded_wall ? timeOf(node.loaded_wall) : null;
  if (errors > 0) return <Line>{words.oldRuns(time)}</Line>;
  if (past !== null) return <Line end={<RunFromHere />}>{text.past.changed}</Line>;
  return (
    <Line
      end={
        <Button small kind="plain" keys="Alt+Shift+U" onClick={() => registry.run('node.load')}>
          {words.upload}
        </Button>
      }
    >
      {words.older(time)}
    </Line>
  );
}

/** more: what else can be done about a file that changed on disk. */
export function DiskNotice({ doc, more }: { doc: Doc; more?: ReactNode }) {
  const studio = useStudio();
  const drives = useDrives();
  const [compare, setCompare] = useState<boolean | null>(null);
  const state = useTopic('doc', { doc });
  const problem = useDocuments((documents) => documents.problemOf(doc)?.what);
  // The server has no version of a text that it does not have.
  if (state?.gone && state.version === 0) return <Line error>{words.onlyHere}</Line>;
  if (state?.gone) return <Line>{words.gone}</Line>;
  if (!state?.disk) return problem === undefined ? null : <Line error>{problem}</Line>;
  const { disk_hash, disk_no_text: noText } = state;
  const isText = kTexts.includes(state.language);
  // Where only one can be kept, it is chosen by looking at both.
  const compares = compare ?? !isText;
  const keep = (which: 'mine' | 'disk' | 'both') => () =>
    void studio
      .change('doc.keep', { doc, which, disk_hash }, doc)
      .catch((problem: unknown) => studio.tell(problem));
  const mine = (
    <Button small disabled={!drives} onClick={keep('mine')}>
      {words.mine}
    </Button>
  );
  if (noText !== undefined)
    return (
      <Line error end={mine}>
        {words.noText(noText)}
      </Line>
    );
  const end = (
    <>
      {more}
      <Button small kind="plain" aria-expanded={compares} onClick={() => setCompare(!compares)}>
        {compares ? words.hide : words.compare}
      </Button>
      {mine}
      <Button small disabled={!drives} onClick={keep('disk')}>
        {words.theirs}
      </Button>
      {isText ? (
        <Button small disabled={!drives} tip={words.bothHelp} onClick={keep('both')}>
          {words.both}
        </Button>
      ) : null}
    </>
  );
  return (
    <>
      <Line end={end}>{isText ? words.disk : `${words.disk} ${words.oneOnly}`}</Line>
      {compares ? (
        <Suspense fallback={null}>
          <Compare doc={doc} version={state.version} disk={disk_hash} />
        </Suspense>
      ) : null}
    </>
  );
}

function Line({ children, end, error }: { children: ReactNode; end?: ReactNode; error?: boolean }) {
  const Icon = error ? IconAlertOctagon : IconAlertTriangle;
  return (
    <div className={error ? 'notice notice--error' : 'notice'} role="status">
      <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
      <span className="ellipsis">{children}</span>
      <span className="grow" />
      {end}
    </div>
  );
}
