import type { Doc, Meter as MeterValue } from '../../../protocol/messages';
import { useTopic, useWindow } from '../../hooks';
import { text } from '../../text';

const words = text.editor;

/** How much of the node's memory the script uses, and where the caret is. */
export function Meters({ doc, isScript }: { doc: Doc; isScript: boolean }) {
  const script = useTopic('script', isScript ? { doc } : null);
  const cursor = useWindow((state) => state.cursor);
  return (
    <div className="meters">
      {script ? (
        <>
          <Meter name={words.bytecode} value={script.bytecode} />
          <Meter name={words.variables} value={script.variables} />
          <Meter name={words.stack} value={script.stack} />
        </>
      ) : null}
      <span className="grow" />
      {cursor?.doc === doc ? (
        <span className="muted num">{words.position(cursor.line, cursor.column)}</span>
      ) : null}
    </div>
  );
}

function Meter({ name, value: { used, of } }: { name: string; value: MeterValue }) {
  const part = of > 0 ? Math.min(100, (used / of) * 100) : 0;
  const level = used > of ? 'is-error' : part > 85 ? 'is-warning' : '';
  return (
    <div className={`meter ${level}`}>
      <span>{name}</span>
      <svg
        className="meter__bar"
        viewBox="0 0 72 6"
        role="meter"
        aria-label={name}
        aria-valuemin={0}
        aria-valuemax={of}
        aria-valuenow={used}
      >
        <rect className="meter__all" width="72" height="6" rx="3" />
        <rect
          className="meter__used"
          width={Math.max(part * 0.72, used > 0 ? 6 : 0)}
          height="6"
          rx="3"
        />
      </svg>
      <span className="num">
        <b>{used}</b> {words.of(of)}
        <span className="meter__unit">{words.unit}</span>
      </span>
    </div>
  );
}
