// Words of drawings: apart from text.ts, as they come with what draws.

import { counted } from '../../text';

export const drawWords = {
  noneSelected: 'Select an element of the plan to see and change its properties.',
  canvas: (name: string) => `Plan ${name}, drawn`,
  failed: 'The plan cannot be opened.',
  broken: 'The text is not valid JSON. Fix it as text; the drawing follows.',
  locked: 'The text is not valid JSON. The last valid version is shown and cannot be edited.',
  sketched: 'The arrows are still being placed. Until then some of them cross boxes.',
  cut: 'Some arrows cross boxes: there are too many long ones to find a way for each. Put actors that lead to each other close together, or make a sub-plan of some.',
  empty: 'Drag an actor here, or type its name in the palette and press Enter.',
  map: 'The whole plan, small',
  start: 'Start',
  terminate: 'terminate',
  ignore: 'ignore',
  roles: {
    actor: 'actor',
    computation: 'computation',
    subplan: 'sub-plan',
    supervisor: 'supervisor',
  },
  startLabel: (first: string | null) =>
    first === null ? 'Start, leads nowhere yet' : `Start, leads to ${first}`,
  elementLabel: (role: string, name: string, template: string, errors: number) =>
    `${name}, ${role} ${template}${errors > 0 ? `, ${counted(errors, 'error', 'errors')}` : ''}`,
  variableLabel: (name: string, type: string) => `${name}, variable, ${type}`,
  findings: (errors: number, warnings: number) =>
    [
      errors > 0 ? counted(errors, 'error', 'errors') : '',
      warnings > 0 ? counted(warnings, 'warning', 'warnings') : '',
    ]
      .filter(Boolean)
      .join(', '),
  seconds: (seconds: string) => `${seconds} s`,
  port: (name: string, target: string) => `${name} leads to ${target}: connect to…`,
  loosePort: (name: string) => `${name} leads nowhere: connect to…`,
  portHelp: 'Drag to a target, or press Enter',
  arrow: (source: string, outcome: string, target: string) =>
    `${source} ${outcome} leads to ${target}`.replace(/ {2,}/g, ' '),
  data: (arrow: { variable: string; element: string; port: string; is: 'in' | 'out' }) =>
    arrow.is === 'in'
      ? `${arrow.variable} feeds ${arrow.port} of ${arrow.element}`
      : `${arrow.port} of ${arrow.element} goes to ${arrow.variable}`,
  dataNow(
    arrow: { variable: string; element: string; port: string; is: 'in' | 'out' },
    value: string | undefined,
    gave: string | undefined,
  ) {
    const now = value === undefined ? '' : `: ${arrow.variable} is ${value}`;
    const input = gave === undefined ? '' : `, its formula gave ${gave}`;
    return `${drawWords.data(arrow)}${now}${input}`;
  },
  turns: (times: number, seconds: number) => `×${times} ${seconds.toFixed(1)} s`,
  times: (times: number) => `×${times}`,
  debugging: 'Look for a mistake',
  noScript: (events: string) => `No script of the project handles ${events}.`,
  active: {
    label: 'What works now',
    show: (actor: string) => `Show ${actor} in the drawing`,
    activation: (count: number) => `step ${count} of the run`,
  },
  break: {
    title: 'Breakpoints',
    conditionHint: 'distance < 5',
    from: 'from hit',
    stops: ({ kind, outcome }: { kind: string; outcome: string }) =>
      kind === 'actor'
        ? 'before it begins'
        : kind === 'state'
          ? `when it ends in ${outcome}`
          : outcome === ''
            ? 'at any of its events'
            : `at ${outcome}`,
    dot: (one: { condition: string; stop_at: number; enabled: boolean }) =>
      [
        'Breakpoint',
        one.condition && ` if ${one.condition}`,
        one.stop_at > 1 && `, from hit ${one.stop_at}`,
        !one.enabled && ', off',
      ]
        .filter(Boolean)
        .join(''),
  },
  raise: {
    title: 'Raise by hand',
    event: (name: string) => `Raise ${name}`,
  },
  subPlans: {
    title: 'sub-plans',
    help: 'Other plans of this project, each as one actor.',
    choose: 'Select a sub-plan first.',
    back: (name: string) => `Back to ${name}`,
    made: (name: string) => `The chosen actors are the plan ${name} now.`,
    whyNot: {
      entries: (names: string) =>
        names === ''
          ? 'Nothing leads to the chosen actors. A sub-plan begins with the one actor that others lead to.'
          : `Others lead to ${names}. A sub-plan begins with one actor: choose actors of which only one is led to.`,
      states: (names: string) =>
        `States of the chosen actors lead to ${names}. A sub-plan is left by OK to one place: choose actors that are left to one.`,
      events: (names: string) =>
        `Events of the chosen actors lead to ${names}. A sub-plan is left by Interrupted to one place: choose actors that are left to one.`,
      interrupted: (names: string) =>
        `An event of ${names} ends the plan as interrupted, which a sub-plan cannot do for its caller. Leave that supervisor out.`,
    },
  },
  tidyTooLong:
    'Placing so many elements takes too long. Choose fewer of them, or none to place all in columns.',
  tidy: 'Tidy',
  add: 'Add',
  zoom: (percent: number) => `Zoom: ${percent} %`,
  zoomTo: 'Zoom to 100 %',
  newTarget: 'New actor',
  newOf: (template: string) => `new ${template}`,
  filterTargets: 'Actor or template',
  find: 'Find in the plan',
  found: 'What was found',
  notFound: (typed: string) => `Nothing in the plan has “${typed}” in it.`,
  code: 'Generated code',
  codeLabel: 'Generated code, read only',
  codeHelp: 'what vagus plan generate writes',
  noCode: 'A plan with errors has no code. Fix these first:',
  exportPicture: 'Export the drawing',
  asSvg: 'As SVG',
  asPng: 'As PNG',
  noPicture: 'The browser cannot draw a picture of this size. Export it as SVG.',
  note: 'Note',
  noteText: 'Text of the note',
  emptyNote: 'Double-click to write',
  noteLabel: (text: string) => `Note: ${text.split('\n')[0] || 'empty'}`,
  noNotes: 'This file keeps something else under "x.notes", where notes would be.',
  width: 'Width',
  height: 'Height',
  connectTo: 'Connect to',
  several: (count: number) =>
    `${count} elements are selected. Delete, copy and moves are for all of them; this form is for one.`,
  connect: (name: string) => `${name}: connect to…`,
  disconnect: 'Remove arrow',
  noPart: 'The clipboard has no elements of a plan.',
  undo: 'Undo',
  redo: 'Redo',
  switches: {
    text: 'Text',
    code: 'Code',
    live: 'What it does',
    data: 'All data arrows',
    map: 'Map',
  },
  rename: 'Rename',
  remove: 'Delete',
  name: 'Name',
  badName: {
    form: 'Letters, digits and _ only, not beginning with a digit.',
    taken: 'There is one of that name already.',
  },
  inputs: 'Inputs',
  noInputs: 'It has no inputs.',
  outputs: 'Outputs',
  dropped: 'dropped',
  states: 'States',
  events: 'Events',
  begins: 'Begins with',
  first: 'first actor',
  nowhere: 'nowhere yet',
  supervisors: 'Supervisors',
  noSupervisors: 'No supervisors.',
  unfed: 'needs a value',
  offers: 'Suggestions',
  default: (value: string) => `${value}  default`,
  variable: 'variable',
  type: 'Type',
  types: { bool: 'bool', int: 'int', float: 'float', string: 'string', object: 'object' },
  initial: 'Initial value',
  unit: 'Unit',
  help: 'Help',
  access: 'For callers',
  accesses: {
    local: 'not seen',
    in: 'input',
    out: 'output',
    inout: 'input and output',
    shared: 'shared',
  },
  aria: {
    'node.a11yDescription.default':
      'Enter selects an element and shows its properties, Tab goes to the next one.',
    'node.a11yDescription.keyboardDisabled': 'Enter selects an element.',
    'node.a11yDescription.ariaLiveMessage': (at: { direction: string; x: number; y: number }) =>
      `Moved ${at.direction}, now at ${at.x}, ${at.y}.`,
    'edge.a11yDescription.default': 'An arrow.',
    'controls.ariaLabel': 'Zoom',
    'controls.zoomIn.ariaLabel': 'Zoom in',
    'controls.zoomOut.ariaLabel': 'Zoom out',
    'controls.fitView.ariaLabel': 'Fit',
    'controls.interactive.ariaLabel': 'Lock',
    'minimap.ariaLabel': 'The whole plan, small',
    'handle.ariaLabel': 'Port',
  },
};
