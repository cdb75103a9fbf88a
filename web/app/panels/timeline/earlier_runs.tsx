import { Menu } from '@mantine/core';
import { IconHistory } from '@tabler/icons-react';
import { useState } from 'react';
import { openRecording } from '../../commands/past_commands';
import { useDrives, useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { StudioMenu } from '../../parts/menu';
import { recordedAt } from '../../parts/recorded_at';
import { useAsked } from '../../use_asked';
import { words } from './words';

/** Runs of this project that were recorded: one that is chosen is run again, and can be looked back into. */
export function EarlierRuns() {
  const [opened, setOpened] = useState(false);
  const drives = useDrives();
  return (
    <StudioMenu
      opened={opened}
      onChange={setOpened}
      button={
        <button
          type="button"
          className="btn btn--plain btn--small btn--icon"
          data-earlier-runs
          aria-label={words.earlier}
          data-tip={words.earlier}
          disabled={!drives}
        >
          <IconHistory size={14} stroke={kStroke} aria-hidden />
        </button>
      }
    >
      {opened ? <Recordings /> : null}
    </StudioMenu>
  );
}

function Recordings() {
  const studio = useStudio();
  const answer = useAsked('recording.list', {});
  const recordings = answer === 'refused' ? [] : answer?.recordings;
  return (
    <>
      <Menu.Label>{words.earlier}</Menu.Label>
      {recordings && recordings.length > 0 ? null : (
        <Menu.Item disabled>{recordings ? words.noEarlier : words.asks}</Menu.Item>
      )}
      {recordings?.map(({ path, number, when_wall, bytes }) => (
        <Menu.Item
          key={path}
          rightSection={<span className="muted num">{words.size(bytes)}</span>}
          onClick={() => void openRecording(studio, path)}
        >
          {words.run(number, recordedAt(when_wall))}
        </Menu.Item>
      ))}
      <Menu.Divider />
      <Menu.Item
        onClick={() =>
          void import('../../commands/compare_runs').then(({ compareRuns }) =>
            compareRuns(studio, recordings?.[0]?.path ?? null),
          )
        }
      >
        {words.compare}
      </Menu.Item>
    </>
  );
}
