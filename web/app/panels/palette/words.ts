// Words of the palette: apart from text.ts, as they come with that panel alone.

import { counted } from '../../text';

export const words = {
  search: (count: number) => `Search ${counted(count, 'template', 'templates')}`,
  none: (typed: string) => `No template has “${typed}” in its name or help.`,
  noPlan: 'Open a plan to add to it, or create one.',
  add: (name: string, role: string) => `${name}, ${role}`,
  hidden: (name: string, by: string, toolbox: string) =>
    `This plan would use the ${name} of ${by}, which it lists first. List ${toolbox} before it to use this one.`,
  variable: 'New variable',
  note: 'New note',
  newTemplate: 'New template…',
  title: 'New template',
  made: (name: string) => `${name} is in the palette. Fill it in here.`,
  kind: 'Kind',
  kinds: { actor: 'actor: does something', supervisor: 'supervisor: watches for something' },
  name: 'Name',
  onNode: 'On the node',
  scriptOf: (node: string, file: string) => `${node} (${file})`,
  helpText: 'What it does',
  whatHappens:
    'Its events and handlers are added to the script of that node, ready to be filled in. Until then it does no harm.',
  noScripts: 'No script here can do work for a plan: add an .aesl file with a node first.',
  make: 'Create',
  cancel: 'Cancel',
  badName: {
    form: 'Letters, digits and _ only, not beginning with a digit.',
    taken: 'There is a template of that name already.',
    event: 'The scripts have events of that name already.',
  },
  whose: 'Select an actor or Start first: a supervisor watches for one of them. Or drop it there.',
};
