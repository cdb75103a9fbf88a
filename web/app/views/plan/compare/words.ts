// Words of plans that are compared: apart from text.ts, as they come with the drawing.

import type { PlanDifference } from '../../../../protocol/messages';
import { counted } from '../../../text';

export const compareWords = {
  commands: {
    compare: 'Compare the plan with…',
    next: 'Next difference',
    previous: 'Previous difference',
    leave: 'Leave the comparison',
  },
  show: 'Show differences',
  menu: 'Compare with…',
  with: 'Compare this plan with',
  disk: 'The file on disk',
  running: 'The version that runs',
  notRuns: 'No plan runs.',
  git: 'A commit of this file',
  noGit: 'Git has no commit of this file.',
  asksGit: 'Git is asked…',
  files: 'Another plan',
  commit: (subject: string, revision: string) => `“${subject}” (${revision.slice(0, 7)})`,
  names: {
    disk: 'the file on disk',
    running: 'the version that runs',
    then: (t: string) => `the version that ran at ${t} s`,
  },
  strip: (name: string) => `Compared with ${name}`,
  waits: 'The versions are compared…',
  none: 'No difference.',
  noPlan: 'Open a plan first.',
  notCompared: 'Compare the plan with another version first.',
  kinds: { added: 'added', changed: 'changed', removed: 'removed', reordered: 'in another order' },
  signs: { added: '+', changed: '≠', removed: '−' },
  places: (count: number) =>
    `${counted(count, 'element stands', 'elements stand')} elsewhere in the drawing`,
  at: (at: number, count: number) => `${at} of ${count}`,
  list: 'All differences',
  mark: (key: string, kind: 'added' | 'changed' | 'removed') => `${key}: ${kind}`,
  nameOf: ({ element, part }: PlanDifference) => (part === '' ? element : `${element}, ${part}`),
  before: 'before',
  after: 'now',
  legend: 'What the marks mean',
  was: 'Dashed: where an arrow led before',
};
