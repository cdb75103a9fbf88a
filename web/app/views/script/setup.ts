// The editor's parts, put together for one document.

import { closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, indentWithTab } from '@codemirror/commands';
import { json } from '@codemirror/lang-json';
import {
  bracketMatching,
  codeFolding,
  foldGutter,
  foldKeymap,
  HighlightStyle,
  indentOnInput,
  indentUnit,
  syntaxHighlighting,
} from '@codemirror/language';
import { highlightSelectionMatches, search, searchKeymap } from '@codemirror/search';
import { Compartment, EditorState, Prec, type Extension } from '@codemirror/state';
import {
  crosshairCursor,
  drawSelection,
  dropCursor,
  EditorView,
  highlightActiveLine,
  keymap,
  lineNumbers,
  rectangularSelection,
} from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { aesl } from '../../../aesl/language';
import { pressedKeys } from '../../../core/keys';
import type { Settings } from '../../../core/settings';

// Classes, so that the colours are those of the theme's tokens.
const colours = HighlightStyle.define([
  { tag: [tags.keyword, tags.bool, tags.null], class: 'k' },
  { tag: [tags.labelName, tags.propertyName], class: 'e' },
  { tag: tags.function(tags.name), class: 'f' },
  { tag: tags.constant(tags.name), class: 'c' },
  { tag: tags.number, class: 'n' },
  { tag: tags.string, class: 's' },
  { tag: tags.comment, class: 'm' },
]);

export const readOnlyPart = new Compartment();
export const settingsPart = new Compartment();

export function makeState(options: {
  text: string;
  language: string;
  label: string;
  extensions: Extension;
  settings: Settings;
  dark: boolean;
  readOnly: boolean;
}): EditorState {
  const { text, language, label, extensions, settings, dark, readOnly } = options;
  return EditorState.create({
    doc: text,
    extensions: [
      extensions,
      lineNumbers(),
      foldGutter({ openText: '⌄', closedText: '›' }),
      codeFolding({ placeholderText: '…' }),
      drawSelection(),
      dropCursor(),
      rectangularSelection(),
      crosshairCursor(),
      indentOnInput(),
      bracketMatching(),
      closeBrackets(),
      highlightActiveLine(),
      highlightSelectionMatches({ minSelectionLength: 2 }),
      search({ top: true }),
      syntaxHighlighting(colours),
      language === 'aesl' ? aesl() : language === 'text' || language === 'aesl-file' ? [] : json(),
      keymap.of([
        ...closeBracketsKeymap,
        ...ownKeys(),
        ...searchKeymap,
        ...foldKeymap.filter(({ key }) => !kTyped.has(key ?? '')),
        ...completionKeymap,
        indentWithTab,
      ]),
      EditorView.contentAttributes.of({
        'aria-label': label,
        tabindex: '0',
        spellcheck: 'false',
        autocorrect: 'off',
      }),
      settingsPart.of(settingsOf(settings, dark)),
      readOnlyPart.of(readOnlyOf(readOnly)),
    ],
  });
}

export function settingsOf(
  settings: Pick<Settings, 'codeSize' | 'spaces' | 'wrap'>,
  dark: boolean,
): Extension {
  const height = Math.round(settings.codeSize * 1.66);
  return [
    EditorView.theme(
      {
        '&': { fontSize: `${settings.codeSize}px` },
        '.cm-content, .cm-gutters': { lineHeight: `${height}px` },
      },
      { dark },
    ),
    indentUnit.of(' '.repeat(settings.spaces)),
    EditorState.tabSize.of(settings.spaces),
    settings.wrap ? EditorView.lineWrapping : [],
  ];
}

export function readOnlyOf(readOnly: boolean): Extension {
  return EditorState.readOnly.of(readOnly);
}

/** As core/keys.ts spells them: with Caps Lock and on any keyboard, Ctrl+Y and Ctrl+Shift+Z never undo. */
const kBackKeys: Readonly<Record<string, 'undo' | 'redo'>> = {
  'Ctrl+Z': 'undo',
  'Ctrl+Y': 'redo',
  'Ctrl+Shift+Z': 'redo',
};

/** Undo and redo by keys and by the browser's menu. */
export function backKeys(isApple: boolean, act: (act: 'undo' | 'redo') => void): Extension {
  // The key is the editor's also where nothing is to undo.
  const back = (view: EditorView, which: 'undo' | 'redo') => {
    if (!view.state.readOnly) act(which);
    return true;
  };
  const pressed = (event: KeyboardEvent, view: EditorView) => {
    const [meant] = pressedKeys(event, isApple).flatMap((key) => kBackKeys[key] ?? []);
    if (meant === undefined) return false;
    event.preventDefault();
    return back(view, meant);
  };
  return [
    Prec.highest(EditorView.domEventHandlers({ keydown: pressed })),
    EditorView.domEventHandlers({
      beforeinput(event, view) {
        const act = { historyUndo: 'undo', historyRedo: 'redo' }[event.inputType];
        if (act !== 'undo' && act !== 'redo') return false;
        event.preventDefault();
        return back(view, act);
      },
    }),
  ];
}

/** On Windows AltGr is Ctrl+Alt as well: German, French and Spanish keyboards type brackets by it. */
const kTyped: ReadonlySet<string> = new Set(['Ctrl-Alt-[', 'Ctrl-Alt-]']);

/** The studio's own keys come first: what it uses is left out here. */
function ownKeys() {
  const taken = new Set([
    'Mod-k',
    'F2',
    'F4',
    'F6',
    'F8',
    'Alt-Enter',
    'Mod-Alt-\\',
    'Alt-l',
    'Ctrl-k',
  ]);
  return defaultKeymap.filter(
    (binding) => !taken.has(binding.key ?? '') && !taken.has(binding.mac ?? ''),
  );
}
