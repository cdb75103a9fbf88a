// Words of plots: apart from text.ts, as they come with that panel alone.

import { counted } from '../../text';

export const words = {
  none: 'Nothing plotted. Press the curve beside a variable.',
  label: (names: string) => `Plot of ${names}`,
  add: 'node.variable',
  span: 'Length',
  seconds: (count: number) => (count < 60 ? `${count} s` : `${count / 60} min`),
  hold: 'Pause the plot',
  go: 'Continue the plot',
  newest: 'Newest',
  newestHelp: 'Back to the newest',
  csv: 'Copy as CSV',
  csvFile: 'Save as CSV',
  png: 'Copy as PNG',
  pngFile: 'Save as PNG',
  table: 'As a table',
  clear: 'Clear the plot',
  axis: (name: string) => `Axis of ${name}`,
  axes: (axis: number) => `Axis ${axis}`,
  remove: (name: string) => `Remove ${name} from the plot`,
  head: { curve: 'Curve', now: 'Value', least: 'Lowest', most: 'Highest', mean: 'Mean' },
  time: 'Time',
  keys: 'Left and right move the cursor, + and - zoom, Home goes back to the newest.',
  tableLabel: (rows: number) => `The last ${counted(rows, 'row', 'rows')} in sight`,
  curves: 'Curves',
  noSamples: 'No value yet.',
  more: 'More',
};
