import { IconDots } from '@tabler/icons-react';
import { Menu } from '@mantine/core';
import { logsCsv, logsOf, type LogRow } from '../../../core/logs';
import { copyText } from '../../commands/clipboard';
import { download } from '../../commands/download';
import { nameOf } from '../../documents';
import { useChanges, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { StudioMenu } from '../../parts/menu';
import { logWords as words, placeName } from './words';

/** Above the hits: the table for other programs. */
export function LogsTools() {
  const studio = useStudio();
  const logs = logsOf(studio);
  useChanges(logs.changed);
  const rows = logs.rows;
  if (rows.length === 0) return null;
  const placeOf = ({ where, point }: LogRow) =>
    where || placeName(point.place, (doc) => nameOf(studio, doc));
  const csv = () => logsCsv(logs.rows, placeOf);
  const copy = () =>
    copyText(studio, csv(), words.copied).catch((problem: unknown) => studio.tell(problem));
  return (
    <div className="logs__tools">
      <StudioMenu
        position="bottom-end"
        button={
          <Button
            kind="plain"
            small
            tip={words.table}
            icon={<IconDots size={14} stroke={kStroke} />}
          />
        }
      >
        <Menu.Item onClick={() => void copy()}>{words.copy}</Menu.Item>
        <Menu.Item onClick={() => download(new Blob([csv()], { type: 'text/csv' }), 'log.csv')}>
          {words.save}
        </Menu.Item>
      </StudioMenu>
    </div>
  );
}
