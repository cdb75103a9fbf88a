// The language as the editor needs it: colours, folding, indentation.

import { foldNodeProp, indentService, LanguageSupport, LRLanguage } from '@codemirror/language';
import { styleTags, tags } from '@lezer/highlight';
import { indentOf } from './indent';
import { parser } from './parser';

const keywords = 'onevent sub call callsub emit _emit var const if while for when end';
/** As far back as the line that decides is looked for. */
const kLinesBack = 50;

const aeslLanguage = LRLanguage.define({
  name: 'aesl',
  parser: parser.configure({
    props: [
      styleTags({
        [keywords]: tags.keyword,
        'Keyword/...': tags.keyword,
        'EventName/...': tags.labelName,
        'SubName/...': tags.labelName,
        'NativeName/...': tags.function(tags.name),
        'ConstantDefinition/...': tags.constant(tags.name),
        ConstantName: tags.constant(tags.name),
        'VariableName/...': tags.variableName,
        'VariableDefinition/...': tags.variableName,
        Number: tags.number,
        'LineComment BlockComment': tags.comment,
      }),
      foldNodeProp.add({
        Block: (node, state) =>
          range(state.doc.lineAt(node.from).to, node.lastChild?.from ?? node.to),
        Handler: (node, state) => range(state.doc.lineAt(node.from).to, node.to),
        BlockComment: (node) => range(node.from + 2, node.to - 2),
      }),
    ],
  }),
  languageData: {
    commentTokens: { line: '#', block: { open: '#*', close: '*#' } },
    indentOnInput: /^\s*(end|else|elseif|onevent|sub)$/,
    closeBrackets: { brackets: ['(', '['] },
    wordChars: '.',
  },
});

const indentation = indentService.of((context, at) => {
  const line = context.lineAt(at, 1);
  const above: string[] = [];
  let from = line.from;
  for (let back = 0; back < kLinesBack && from > 0; back++) {
    const before = context.lineAt(from - 1, -1);
    above.unshift(before.text);
    from = before.from;
  }
  return indentOf(above, line.text, context.unit);
});

export function aesl(): LanguageSupport {
  return new LanguageSupport(aeslLanguage, indentation);
}

function range(from: number, to: number): { from: number; to: number } | null {
  return to > from ? { from, to } : null;
}
