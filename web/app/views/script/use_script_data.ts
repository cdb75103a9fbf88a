// Brings what the server knows of a script into its editor.

import type { EditorView } from '@codemirror/view';
import { toggleComment } from '@codemirror/commands';
import { startCompletion } from '@codemirror/autocomplete';
import { openSearchPanel } from '@codemirror/search';
import { useCallback, useEffect, useMemo, useState } from 'react';
import type {
  Breakpoint,
  Doc,
  Finding,
  Handler,
  HistoryNode,
  Node,
} from '../../../protocol/messages';
import { wordAt } from '../../../core/help/entries';
import { logLinesOf, type LogLine } from '../../../core/log_lines';
import { mentionedIn, readWords, valueText } from '../../../core/values';
import { pausedLineOf } from '../../../core/run_state';
import type { TextSession } from '../../../core/session/text_session';
import type { Settings } from '../../../core/settings';
import { update } from '../../../core/window_state';
import { addEditor } from '../../commands/editor_handles';
import { pressFix } from '../../commands/problem_commands';
import { useChanges, useMayEdit, useSettings, useStudio, useTopic, useWindow } from '../../hooks';
import { useNodeThen } from '../../past_hooks';
import { useShownTheme } from '../../robot_hooks';
import { text } from '../../text';
import {
  findReferences,
  goTo,
  goToDefinition,
  editBreakpoint,
  toggleBreakpoint,
} from './editor_acts';
import { setFindings } from './findings';
import { setBreaks, setChips, setStanding, type BreakMark } from './line_marks';
import { offsetOf } from './places';
import { readOnlyOf, readOnlyPart, settingsOf, settingsPart } from './setup';
import { useEffectIn } from './use_editor';
import { showView } from './views';

export function useScriptData(doc: Doc, isScript: boolean, view: EditorView | null): void {
  const studio = useStudio();
  const settings = useSettings();
  const mayEdit = useMayEdit();
  const script = useTopic('script', isScript ? { doc } : null);
  const told = useToldFindings(doc);
  const breakpoints = useTopic('breakpoints', {})?.breakpoints;
  const logs = logLinesOf(studio);
  useChanges(logs.changed);
  const logged = logs.all;
  const handlers = script?.handlers;
  const { showWords } = settings;
  useEffectIn(
    view,
    useCallback(
      () =>
        setFindings.of({
          findings: told.findings,
          onFix: (finding, fix) => pressFix(studio, finding, fix),
        }),
      [studio, told],
    ),
  );
  useEffectIn(
    view,
    useCallback(() => setChips.of(showWords ? chipsOf(handlers ?? []) : []), [handlers, showWords]),
  );
  useEffectIn(
    view,
    useCallback(
      () =>
        setBreaks.of([
          ...(breakpoints ?? []).filter((one) => one.doc === doc).map(markOf),
          ...logged.filter((one) => one.doc === doc).map(logMarkOf),
        ]),
      [breakpoints, logged, doc],
    ),
  );
  useEffectIn(
    view,
    useCallback(() => readOnlyPart.reconfigure(readOnlyOf(!mayEdit)), [mayEdit]),
  );
  useLooks(view, settings);
  useStandingIn(doc, isScript, view);
  useRevealIn(doc, view);
  useHandle(doc, view);
}

/** A new value for each version that was checked, even if its findings are the same: they belong to that text. */
function useToldFindings(doc: Doc): { findings: readonly Finding[]; version: number | undefined } {
  const topic = useTopic('findings', {});
  const all = topic?.findings;
  const version = topic?.versions[doc];
  return useMemo(
    () => ({ findings: all?.filter((one) => one.doc === doc) ?? [], version }),
    [all, doc, version],
  );
}

/** Letters and colours, as they are set. */
function useLooks(view: EditorView | null, settings: Settings): void {
  const { codeSize, spaces, wrap } = settings;
  const isDark = useShownTheme() !== 'light';
  useEffectIn(
    view,
    useCallback(
      () => settingsPart.reconfigure(settingsOf({ codeSize, spaces, wrap }, isDark)),
      [codeSize, spaces, wrap, isDark],
    ),
  );
}

function chipsOf(handlers: readonly Handler[]) {
  return handlers
    .filter((one) => one.kind !== 'init')
    .map(({ line, words }) => ({ line, text: text.editor.words(words) }));
}

function markOf(one: Breakpoint): BreakMark {
  const { line, enabled, condition, ignore, set, why, hits } = one;
  const words = text.editor;
  const notes = [
    condition && words.if(condition),
    ignore > 0 && words.after(ignore),
    !enabled && words.off,
    !set && why,
  ].filter(Boolean);
  const kind = !enabled ? 'off' : condition || ignore > 0 ? 'if' : !set && why ? 'unset' : 'on';
  return {
    line,
    kind,
    label: `${words.breakpoint(line)}, ${words.hits(hits)}`,
    note: notes.join(', '),
  };
}

function logMarkOf({ line, values }: LogLine): BreakMark {
  const { logPoint, logs } = text.editor;
  return { line, kind: 'log', label: logPoint(line), note: values === '' ? '' : logs(values) };
}

/** Where the node is paused, and what the line's variables are. */
function useStandingIn(doc: Doc, isScript: boolean, view: EditorView | null): void {
  const robot = useTopic('robot', {});
  const node = isScript ? robot?.nodes.find((one) => one.doc === doc) : undefined;
  const then = useNodeThen(node?.id);
  const line = then ? lineThen(then) : pausedLineOf(node);
  const code =
    line !== undefined && view && line <= view.state.doc.lines
      ? view.state.doc.line(line).text
      : '';
  // Values of now are none of then.
  const values = useLineValues(line === undefined || then ? undefined : node, code);
  useEffectIn(
    view,
    useCallback(() => setStanding.of(line === undefined ? null : { line, values }), [line, values]),
  );
  useEffect(() => {
    if (view && line !== undefined)
      goTo(view, offsetOf(view.state.doc, { line, column: 1 }), false);
  }, [view, line]);
}

function lineThen({ state, line }: Partial<HistoryNode>): number | undefined {
  return state === 'running' ? undefined : line;
}

function useLineValues(node: Node | undefined, code: string): string {
  const studio = useStudio();
  const variables = useTopic('node', node ? { node: node.id } : null)?.variables;
  const mentioned = useMemo(() => mentionedIn(code, variables ?? []), [code, variables]);
  const [shown, setShown] = useState('');
  const id = node?.id;
  useEffect(() => {
    if (id === undefined || mentioned.length === 0) return;
    const words = new Map<number, number>();
    const ranges = mentioned.map(({ address, count }) => [address, count]);
    const end = studio.connection.watch(
      'variables',
      { node: id, ranges },
      {
        frame(_time, payload) {
          readWords(payload, words);
          setShown(
            mentioned
              .map((one) => valueText(one, words))
              .filter(Boolean)
              .join('   '),
          );
        },
      },
    );
    return () => {
      end();
      setShown('');
    };
  }, [studio, id, mentioned]);
  return shown;
}

/** Goes to the place that someone wants to see. */
function useRevealIn(doc: Doc, view: EditorView | null): void {
  const { window: store } = useStudio();
  const reveal = useWindow((state) => state.reveal);
  useEffect(() => {
    if (!view || reveal?.what !== 'doc' || reveal.doc !== doc || !reveal.at) return;
    goTo(view, offsetOf(view.state.doc, reveal.at), reveal.focus);
    update(store, (draft) => void (draft.reveal = null));
  }, [store, view, reveal, doc]);
}

function useHandle(doc: Doc, view: EditorView | null): void {
  const studio = useStudio();
  useEffect(() => {
    if (!view) return;
    const head = () => view.state.selection.main.head;
    const line = () => view.state.doc.lineAt(head()).number;
    const held = studio.documents.acquire(doc);
    let session: TextSession | null = null;
    held.opened.then(
      (opened) => void (session = opened.session),
      () => {},
    );
    const tell = (act: Promise<void>) => void act.catch((problem: unknown) => studio.tell(problem));
    const ends = [
      showView(studio, doc, view),
      addEditor(studio, doc, {
        toggleBreakpoint: () => toggleBreakpoint(studio, doc, line()),
        editBreakpoint: () => editBreakpoint(studio, doc, line()),
        definition: () => tell(goToDefinition(studio, doc, head())),
        references: () => tell(findReferences(studio, doc, head())),
        rename: () =>
          update(studio.window, (draft) => void (draft.form = { doc, is: 'rename', line: line() })),
        complete: () => void startCompletion(view),
        find: () => void openSearchPanel(view),
        comment: () => void toggleComment(view),
        undo: () => void session?.undo(),
        redo: () => void session?.redo(),
        mayUndo: () => !view.state.readOnly && (session?.canUndo ?? false),
        mayRedo: () => !view.state.readOnly && (session?.canRedo ?? false),
        focus: () => view.focus(),
        line,
        word: () => {
          const { text, from } = view.state.doc.lineAt(head());
          return view.hasFocus ? wordAt(text, head() - from) : '';
        },
      }),
    ];
    return () => {
      ends.forEach((end) => end());
      held.release();
    };
  }, [studio, doc, view]);
}
