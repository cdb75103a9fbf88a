// Words of two runs side by side: apart from text.ts, as they come with their panel.

export const runWords = {
  form: 'Which runs are compared',
  shown: 'The run that is shown',
  run: (number: number, when: string) => `Run ${number}, until ${when}`,
  align: 'Aligned at',
  aligns: { start: 'the beginning', actor: 'an actor', event: 'an event' },
  name: { actor: 'Name of the actor', event: 'Name of the event' },
  compare: 'Compare',
  how: 'Choose two recorded runs: where each thing of them differs first is listed here, and both are drawn one above the other.',
  waits: 'Both recordings are read…',
  same: 'No difference: both runs are the same.',
  differs: (lanes: number, t: string) =>
    `${lanes === 1 ? 'One lane differs' : `${lanes} lanes differ`}, the first at ${t} s.`,
  started: 'Started with another',
  lanes: 'First difference of each lane, the earliest first',
  none: 'No difference:',
  nothing: 'nothing',
  at: (t: string) => `${t} s`,
  atBoth: (a: string, b: string) => `${a} s of A, ${b} s of B`,
  tracks: 'Actors of both runs, by time',
  cursor: 'Instant that is shown of both',
  seconds: (t: string) => `${t} seconds`,
  open: (side: string) => `Show ${side} here`,
  openHelp: (side: string) =>
    `Everything in the window shows this instant of ${side}; a recording is run again first.`,
  world: 'Both robots in one world, from above: A with a line, B dashed',
  more: (count: number) => `${count} actors and events are not drawn.`,
  cut: (side: string) => `${side} has not ended: it is compared as far as it is recorded.`,
};
