// C++ for the eye, as far as generated programs need it.

import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import type { Extension } from '@codemirror/state';
import { tags } from '@lezer/highlight';

const keyword = /^(using|namespace|return|true|false|auto|const)\b/;

const cpp = StreamLanguage.define({
  name: 'cpp',
  token(stream) {
    if (stream.eatSpace()) return null;
    if (stream.match(/^\/\/.*/)) return 'comment';
    if (stream.match(/^#.*/)) return 'meta';
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return 'string';
    if (stream.match(/^\d[\w.']*/)) return 'number';
    if (stream.match(keyword)) return 'keyword';
    if (stream.match(/^\.?[A-Za-z_]\w*/)) return null;
    stream.next();
    return null;
  },
});

// Classes, so that the colours are those of the theme's tokens.
const colours = HighlightStyle.define([
  { tag: tags.keyword, class: 'k' },
  { tag: tags.number, class: 'n' },
  { tag: tags.string, class: 's' },
  { tag: tags.comment, class: 'm' },
  { tag: tags.meta, class: 'c' },
]);

export const cppColours: Extension = [cpp, syntaxHighlighting(colours)];
