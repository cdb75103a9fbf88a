// Words of the answer to “When was it decided?”: apart from text.ts, as they come with it.

import type { Deciding } from '../../../core/deciding';

type Stage = NonNullable<Deciding['progress']>['stage'];

export const decidedWords = {
  form: 'When was it decided?',
  condition: 'Condition',
  example: 'contact >= 2',
  how: 'The run is continued many times with different noise of sensors and wheels and different random numbers. The answer is the share of continuations in which the condition becomes true. Conditions are written as in tests: contact >= 2, actor == "backup", event == "LaneNotFree", x < 0.2.',
  tries: 'Tries',
  triesHelp: 'Continuations from each instant',
  ask: 'Ask',
  stop: 'Stop',
  progress: 'Continuations',
  of: (done: number, of: number) => `${done} of ${of}`,
  stopped: 'Stopped.',
  earlier: 'This was asked of a run before this one.',
  came: (t: string) => `In this run it became true at ${t} s.`,
  never: (t: string) => `In this run it did not become true by ${t} s.`,
  curve: 'Continuations in which it became true, by the instant from which they differ',
  chart: (sentence: string) => `Curve over time: ${sentence}`,
  share: 'Share',
  all: 'all',
  none: 'none',
  table: 'Numbers',
  instant: 'From',
  likely: '95 % interval',
  end: 'the end',
  percent: (low: number, high: number) =>
    `${Math.round(low * 100)} % to ${Math.round(high * 100)} %`,
  look: (t: string) => `Look at ${t} s`,
  there: 'What happened there',
  with: 'Open a continuation in which it becomes true',
  without: 'Open a continuation in which it does not',
  noOther: (comes: boolean) =>
    comes
      ? 'No continuation was found in which it becomes true.'
      : 'No continuation was found in which it does not.',
};

export const stageWords: Record<Stage, string> = {
  run: 'Running it again…',
  curve: 'Continuing it from instants throughout the run…',
  narrowing: 'Narrowing down the instant…',
  recordings: 'Recording two continuations…',
};
