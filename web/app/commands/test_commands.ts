import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { text } from '../text';
import { drives, mayAct } from './looks';
import { runTests, stopTests, testMeant } from './test_acts';

const group = text.groups.run;

/** In a test F5 runs it; in all else it runs the robot. */
export function testCommands(studio: Studio): Command[] {
  return [
    {
      id: 'tests.run',
      title: 'Run this test',
      group,
      keys: ['F5'],
      // While a person looks back the key is that of Run from here.
      enabled: () => mayAct(studio) && testMeant(studio) !== null,
      run: () => runTests(studio, [testMeant(studio) ?? '']),
    },
    {
      id: 'tests.runAll',
      title: 'Run all tests of the project',
      group,
      enabled: () => drives(studio),
      run: () => runTests(studio, null),
    },
    {
      id: 'tests.stop',
      title: 'Stop running tests',
      group,
      // Where nobody follows them they may be running.
      enabled: () =>
        drives(studio) && (studio.topics.get('tests', {})?.state ?? 'running') === 'running',
      run: () => stopTests(studio),
    },
  ];
}
