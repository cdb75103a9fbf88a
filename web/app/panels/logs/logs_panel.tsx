import { IconList } from '@tabler/icons-react';
import { useRef } from 'react';
import { logsOf } from '../../../core/logs';
import { useChanges, useStudio } from '../../hooks';
import { Blank } from '../../parts/blank';
import { kStroke } from '../../parts/icons';
import { Hits } from './hits';
import { LogsTools } from './logs_tools';
import { PointRow } from './point_row';
import { logWords as words } from './words';
import '../../look/logs.css';

/** What variables held each time that a place was reached: each a click from that instant. */
export default function LogsPanel() {
  const logs = logsOf(useStudio());
  useChanges(logs.changed);
  const frame = useRef<HTMLDivElement>(null);
  const { points, asking, isSlow } = logs;
  const rows = logs.rows;
  if (points.length === 0)
    return (
      <Blank
        title={words.nothing}
        icon={<IconList className="icon" size={18} stroke={kStroke} aria-hidden />}
      >
        {words.how}
      </Blank>
    );
  const toHits = () => frame.current?.querySelector<HTMLElement>('[data-row]')?.focus();
  return (
    <div className="logs" ref={frame}>
      <ul className="logs__points" aria-label={words.points}>
        {points.map((point) => (
          <PointRow key={point.number} point={point} onDown={toHits} />
        ))}
      </ul>
      <p className="hidden-text" role="status">
        {asking !== null ? words.waits : ''}
      </p>
      {isSlow ? (
        <p className="logs__note" role="status">
          {words.takesLong}
        </p>
      ) : null}
      <LogsTools />
      {rows.length > 0 ? <Hits rows={rows} /> : null}
    </div>
  );
}
