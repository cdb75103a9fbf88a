import type { LogPoint } from '../../../core/logs';
import { useStudio } from '../../hooks';
import { shownView } from '../../views/script/views';
import { logWords as words } from './words';
import '../../look/lists.css';

/** Why it was not answered; what is not listed; the line as it was, if it is another by now. */
export function PointNotes({ point, trouble }: { point: LogPoint; trouble: string }) {
  const studio = useStudio();
  const { place, found } = point;
  const lines = place.is === 'line' ? shownView(studio, place.doc)?.state.doc : undefined;
  const isThere = place.is === 'line' && lines !== undefined && place.line <= lines.lines;
  const now = isThere ? lines.line(place.line).text.replaceAll(/\s/g, ' ').trim() : undefined;
  const then = found?.text.trim() ?? '';
  const isOther = then !== '' && now !== undefined && now !== then;
  return (
    <>
      {trouble ? (
        <p className="planform__why logs__why" role="alert">
          {trouble}
        </p>
      ) : null}
      {found && found.more > 0 ? <p className="logs__note">{words.more(found.more)}</p> : null}
      {isOther ? (
        <p className="logs__note">
          {words.lineThen} <code>{then}</code>
        </p>
      ) : null}
    </>
  );
}
