/** What is said while a person looks back. Loaded then. */
export const pastWords = {
  label: 'Looking back',
  ago: (seconds: string) => `${seconds} s ago.`,
  everything: (at: string) => `Everything shows ${at} s.`,
  waits: (at: string) => `${at} s is shown when the studio is back.`,
  meanwhile: {
    runs: 'The run continues; nothing here changes it.',
    paused: 'The run is paused; nothing here changes it.',
    over: 'Nothing runs now.',
  },
  trace: (name: string) => `Showing ${name}.`,
  nothingRuns: 'Nothing runs.',
  thinned: 'Older than ten minutes: kept five times a second.',
  said: 'Looking back. Arrow keys go through time, Escape leads back to now.',
  back: 'Back to now',
  close: 'Close the recording',
  continueTip:
    'From this instant, with files as they are now. The run until now stays as a recording',
  stepBefore: 'To the step of the plan before',
  stepAfter: 'To the next step of the plan',
};
