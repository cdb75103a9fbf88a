// Words of the search in all texts: apart from text.ts, as they come with its panel.

import { counted } from '../text';

export const searchWords = {
  find: 'Find',
  replace: 'Replace with',
  case: 'Match case',
  whole: 'Whole words',
  regex: 'Regular expression',
  go: 'Search',
  replaceAll: 'Replace all',
  replaced: (places: number, docs: number) =>
    `${counted(places, 'place', 'places')} in ${counted(docs, 'text', 'texts')} replaced.`,
  found: (spots: number, docs: number) =>
    `${counted(spots, 'place', 'places')} in ${counted(docs, 'text', 'texts')}`,
  more: 'There are more. Search for something longer.',
  results: 'Places found',
};
