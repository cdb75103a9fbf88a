// Words of plans tried by hand: apart from text.ts, as they come with the drawing.

export const tryWords = {
  command: 'Try the plan by hand',
  button: 'Try',
  tip: 'Runs the plan without a robot: you choose how each actor ends',
  label: 'Try',
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
  outputs: 'Outputs of the active actor',
  gives: 'giving',
  kept: 'nothing',
  outputHelp: 'Empty: the actor gives no value for it, and the variable keeps what it has',
  wrong: (output: string, type: string) =>
    `${output} must be ${type === 'bool' ? 'true or false' : type === 'int' ? 'a whole number' : 'a number'}`,
  back: 'Take back the last choice',
  again: 'Start again',
  keep: 'Keep as a test',
  keepHelp: 'Writes a test that takes this way, and opens it',
  saved: (path: string) => `${path} takes this way. Run this test (F5) runs it.`,
  leave: 'Leave Try',
  lane: 'The way so far',
  toBeginning: (actor: string) => `Back to where ${actor} began`,
};
