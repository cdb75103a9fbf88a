// Words of plans tried by hand: apart from text.ts, as they come with the drawing.

export const tryWords = {
  command: 'Try the plan by hand',
  button: 'Try',
  tip: 'Runs the plan without a robot: you choose how each actor ends',
  label: 'Try',
  title: (name: string) => `Try ${name}`,
  ends: (actor: string) => `${actor} is active. How does it end?`,
  noEnd: (actor: string) => `${actor} is active and ends only by an event.`,
  raises: 'Or a supervisor raises',
  over: {
    OK: 'The plan ended: OK.',
    Interrupted: 'The plan was interrupted.',
    Error: 'The plan ended with an error:',
  },
  waits: 'The plan runs…',
  states: (actor: string) => `${actor} ends in`,
  events: 'Raise',
  event: (supervisor: string, event: string) => `${supervisor}: ${event}`,
  back: 'Take back the last choice',
  again: 'Start again',
  keep: 'Keep as a test',
  keepHelp: 'Writes a test that takes this way; vagus test runs it',
  kept: (path: string) => `${path} takes this way. Run it with vagus test.`,
  leave: 'Leave Try',
  lane: 'The way so far',
  turn: (actor: string, end: string | undefined) =>
    end === undefined
      ? `${actor}, active: go back to its beginning`
      : `${actor}, ${end}: go back to its beginning`,
  from: (t: string) => `${t} s`,
};
