import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { findHelp, languageEntries, robotEntries, wordAt, type HelpEntry } from './entries';
import { examplesIn, piecesOf, sectionsOf } from './page';

const page = (name: string) =>
  sectionsOf(readFileSync(new URL(`../../../docs/${name}`, import.meta.url), 'utf8'));
const language = languageEntries(page('aesl.md'));
const named = (entries: readonly HelpEntry[], name: string) =>
  entries.find((entry) => entry.name === name);

describe('a page', () => {
  test('HasSectionsWithTextListsTablesAndExamples', () => {
    const [section] = sectionsOf(
      [
        '# Title',
        'above',
        '## 2. Names: `var`',
        'One line',
        'and the next.',
        '',
        '- First: `x`',
        '  goes on',
        '- Second',
        '',
        '<!-- file try.aesl -->',
        '```aesl',
        'var a',
        '```',
        '<!-- wrong: write "==" -->',
        '```aesl',
        'if a = 1 then',
        '```',
        '<!-- shell -->',
        '```sh',
        './run',
        '```',
        '| sign | means |',
        '| --- | --- |',
        '| `\\|` | or |',
      ].join('\n'),
    );
    expect(section).toEqual({
      title: 'Names: `var`',
      blocks: [
        { is: 'text', text: 'One line and the next.' },
        { is: 'list', items: ['First: `x` goes on', 'Second'] },
        { is: 'code', text: 'var a' },
        { is: 'table', head: ['sign', 'means'], rows: [['`|`', 'or']] },
      ],
    });
  });

  test('IsReadInPieces', () =>
    expect(piecesOf('a **b** *c* `d*e` [f](g.md) h * i')).toEqual([
      { text: 'a ', is: 'plain' },
      { text: 'b', is: 'strong' },
      { text: ' ', is: 'plain' },
      { text: 'c', is: 'emphasis' },
      { text: ' ', is: 'plain' },
      { text: 'd*e', is: 'code' },
      { text: ' f h * i', is: 'plain' },
    ]));
});

describe('the help of the language', () => {
  test('HasASectionWithAnExampleForEveryWord', () => {
    const words = language.filter(({ kind }) => kind === 'word');
    expect(words.length).toBe(24);
    for (const { name, section } of words)
      expect(section && examplesIn([section]).length + section.blocks.length, name).toBeGreaterThan(
        1,
      );
  });

  test.each([
    ['if', 'Deciding: `if`'],
    ['end', 'Deciding: `if`'],
    ['and', 'Deciding: `if`'],
    ['when', 'Becoming true: `when`'],
    ['for', 'Repeating: `for` and `while`'],
    ['step', 'Repeating: `for` and `while`'],
    ['call', 'Functions of the robot, and your own'],
    ['sub', 'Functions of the robot, and your own'],
    ['return', 'Functions of the robot, and your own'],
    ['onevent', 'Something happens, the robot reacts'],
    ['var', 'Numbers and names'],
    ['abs', 'Calculating'],
    ['_emit', 'Telling others: `emit`'],
  ])('ExplainsWhereItIsTaught %s', (word, title) =>
    expect(named(language, word)?.section?.title).toBe(title),
  );
});

const variable = { address: 0, size: 1, of: 'node', writable: true } as const;
const thymio = {
  name: 'thymio-II',
  variables: [
    { ...variable, name: 'motor.left.target', help: 'wanted speed' },
    { ...variable, name: 'timer.period', size: 2, unit: 'ms' },
    { ...variable, name: 'own', of: 'script' as const },
  ],
  events: [{ name: 'prox', help: 'new values of sensors' }],
  natives: [
    {
      name: 'math.stat',
      help: 'min, max and mean',
      parameters: [
        { name: 'src', size: -1 },
        { name: 'mean', size: 1 },
      ],
    },
    { name: 'rot', help: '', parameters: [{ name: 'v', size: 2 }] },
  ],
};

describe('the help of a robot', () => {
  const examples = examplesIn([...page('aesl.md'), ...page('thymio.md')]);
  const robot = robotEntries([thymio, { ...thymio, events: [] }], examples);

  test('HasWhatNodesTellOnceForEachName', () =>
    expect(robot.map(({ kind, form }) => `${kind}: ${form}`)).toEqual([
      'variable: motor.left.target = …',
      'variable: timer.period[2] = … ms',
      'event: onevent prox',
      'native: call math.stat(src, mean)',
      'native: call rot(v[2])',
    ]));

  test('HasAnExampleWhereADocumentHasOne', () => {
    expect(named(robot, 'motor.left.target')?.example).toContain('onevent button.center');
    expect(named(robot, 'prox')?.example).toContain('if prox.horizontal[2] > 2000 then');
    expect(named(robot, 'math.stat')?.example).toContain('call math.stat(');
    expect(named(robot, 'rot')).not.toHaveProperty('example');
  });

  test.each([
    ['if', 'if'],
    ['prox', 'prox'],
    ['mlt', 'motor.left.target'],
    ['wanted', 'motor.left.target'],
  ])('IsFoundBy %s', (query, name) =>
    expect(findHelp([...language, ...robot], query)[0]?.name).toBe(name),
  );

  test('IsFoundByWhatIsNowhereNot', () => expect(findHelp(robot, 'qqq')).toEqual([]));
});

test.each([
  ['motor.left.target = 3', 8, 'motor.left.target'],
  ['motor.left.target = 3', 18, ''],
  ['call math.sin(a, b)', 4, 'call'],
  ['  if x then', 4, 'if'],
  ['# über', 4, 'über'],
])('TheWordAtThePlaceIs %s %i', (line, offset, word) => expect(wordAt(line, offset)).toBe(word));
