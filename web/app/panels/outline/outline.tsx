import type { Doc, Handler } from '../../../protocol/messages';
import { partOf } from '../../../core/paths';
import { revealDoc } from '../../../core/window_state';
import { useStudio, useTopic, useWindow } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { text } from '../../text';
import { Definitions } from './definitions';
import { Group } from './group';

/** Handlers of the script that is looked at; events and constants that its file shares. */
export function Outline() {
  const doc = useWindow((state) => state.doc);
  const scripts = useTopic('scripts', {});
  const part = scripts?.parts.find((one) => one.doc === doc) ?? scripts?.parts[0];
  const file =
    scripts?.files.find((one) => one.path === (doc ? partOf(doc).file : '')) ?? scripts?.files[0];
  return (
    <>
      {part ? <Handlers doc={part.doc} name={part.name} shown={part.doc === doc} /> : null}
      {file ? <Definitions file={file} kind="event" /> : null}
      {file ? <Definitions file={file} kind="constant" /> : null}
    </>
  );
}

function Handlers({ doc, name, shown }: { doc: Doc; name: string; shown: boolean }) {
  const script = useTopic('script', { doc });
  const handlers = script?.handlers ?? [];
  const cursor = useWindow((state) => (state.cursor?.doc === doc ? state.cursor.line : 0));
  const own = handlers.filter((handler) => handler.kind !== 'init' || handler.words > 0);
  const current = shown ? own.findLast((handler) => handler.line <= cursor) : undefined;
  return (
    <Group title={text.outline.handlers(name)} note={text.outline.words} open>
      <ul>
        {own.map((handler) => (
          <HandlerRow
            key={`${handler.kind} ${handler.name} ${handler.line}`}
            doc={doc}
            handler={handler}
            current={handler === current}
          />
        ))}
      </ul>
      {own.length === 0 ? (
        <Quiet>{script?.good === false ? text.empty.handlersLater : text.empty.handlers}</Quiet>
      ) : null}
    </Group>
  );
}

const short = { init: '', event: 'on', sub: 'sub' };

function HandlerRow({ doc, handler, current }: { doc: Doc; handler: Handler; current: boolean }) {
  const { window: store } = useStudio();
  const { kind, name, line, words } = handler;
  return (
    <li>
      <button
        type="button"
        className={current ? 'row outline is-current' : 'row outline'}
        onClick={() => revealDoc(store, doc, { line: Math.max(line, 1), column: 1 })}
      >
        <span className="outline__kind">{short[kind]}</span>
        <code className="ellipsis">{kind === 'init' ? text.outline.init : name}</code>
        <span className="outline__words num">{words}</span>
      </button>
    </li>
  );
}
