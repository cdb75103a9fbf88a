import { useEffect, useRef, useState } from 'react';
import type { Doc, ListingLine } from '../../../protocol/messages';
import { useStudio, useTopic, useWindow } from '../../hooks';
import { text } from '../../text';

/** The bytecode of the script; what belongs to the caret's line is marked. */
export function Listing({ doc }: { doc: Doc }) {
  const lines = useListing(doc);
  const current = useWindow((state) => (state.cursor?.doc === doc ? state.cursor.line : 0));
  const list = useRef<HTMLOListElement>(null);
  useEffect(() => {
    list.current?.querySelector('.is-on')?.scrollIntoView({ block: 'nearest' });
  }, [current, lines]);
  return (
    <ol className="listing" ref={list} aria-label={text.editor.listing} tabIndex={0} data-inset>
      {lines.map((one) => (
        <li key={one.address} className={one.line === current ? 'is-on' : ''}>
          <span className="num">{one.line || ''}</span>
          <span className="num">{one.address}</span>
          <code>{one.text}</code>
        </li>
      ))}
    </ol>
  );
}

/** Asked again with each version that compiles. */
function useListing(doc: Doc): ListingLine[] {
  const studio = useStudio();
  const script = useTopic('script', { doc });
  const version = script?.good ? script.version : undefined;
  const [lines, setLines] = useState<ListingLine[]>([]);
  useEffect(() => {
    if (version === undefined) return;
    let current = true;
    studio.send('script.listing', { doc }).then(
      (answer) => current && setLines(answer.lines),
      () => {},
    );
    return () => void (current = false);
  }, [studio, doc, version]);
  return lines;
}
