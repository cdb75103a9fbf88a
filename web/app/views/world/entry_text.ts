// How what happens in a world by itself is said.

import { entryOf, numberOf, tableAt, tableOf, textOf, verbs } from '../../../core/world/file';
import type { Json } from '../../../protocol/messages';
import { formWords } from './form_words';

export function entryText(file: Json, key: string): { t: string; what: string } {
  const entry = entryOf(file, key);
  const verb = verbs.find((one) => one === entry['do']);
  const what =
    textOf(entry['id']) ||
    textOf(entry['button']) ||
    textOf(tableAt(file, key)['id']) ||
    textOf(tableOf(entry['object'])['kind']) ||
    textOf(entry['robot']);
  return {
    t: `${numberOf(entry['t'], 0)} s`,
    what: verb ? formWords.entryText[verb](what) : textOf(entry['do']),
  };
}
