import { IconTestPipe } from '@tabler/icons-react';
import { useTopic } from '../../hooks';
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
