import { IconTestPipe } from '@tabler/icons-react';
import { useEffect, useRef } from 'react';
import type { Tests } from '../../../core/tests';
import { toast } from '../../../core/window_state';
import { useStudio, useTopic } from '../../hooks';
import { Blank } from '../../parts/blank';
import { kStroke } from '../../parts/icons';
import { testWords as words } from '../../views/tests/words';
import { CoverageTable } from './coverage_table';
import { TestHead } from './test_head';
import { TestList } from './test_list';
import '../../look/tests.css';

/** Tests of behaviour that are run, or were run last: what came of them, and what they went through. */
export default function TestsPanel() {
  const tests = useTopic('tests', {});
  useLostTests(tests?.state);
  if (!tests) return null;
  return (
    <div className="tests">
      <TestHead tests={tests} />
      {tests.state === 'none' ? (
        <Blank
          title={words.none}
          icon={<IconTestPipe className="icon" size={18} stroke={kStroke} aria-hidden />}
        >
          {words.how}
        </Blank>
      ) : (
        <div className="scroll">
          <TestList tests={tests} />
          {tests.coverage.length > 0 ? <CoverageTable rows={tests.coverage} /> : null}
        </div>
      )}
    </div>
  );
}

/** The server keeps results as long as it runs: they are gone when it was started again. */
function useLostTests(state: Tests['state'] | undefined): void {
  const { window: store } = useStudio();
  const before = useRef(state);
  useEffect(() => {
    const had = before.current;
    before.current = state;
    if (state === 'none' && had !== undefined && had !== 'none')
      toast(store, 'warning', words.lost);
  }, [store, state]);
}
