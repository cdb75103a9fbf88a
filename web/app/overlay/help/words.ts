// Words of the help: apart from text.ts, as they come with it.

export const helpWords = {
  title: 'Help',
  tabs: { help: 'Help', keys: 'Keys' },
  search: 'Word of the language, variable, event or function',
  found: 'What was found',
  none: 'Nothing of that name. Try fewer letters.',
  noRobot: 'Connect a robot or open a world: its variables, events and functions appear here, too.',
  kinds: {
    word: 'Language',
    topic: 'Language',
    variable: 'Variable',
    event: 'Event',
    native: 'Native function',
  },
  example: 'Example',
  of: (kind: string, node: string) => (node ? `${kind} of ${node}` : kind),
};
