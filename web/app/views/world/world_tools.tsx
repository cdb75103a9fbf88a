import { Menu } from '@mantine/core';
import {
  IconArrowsMaximize,
  IconCube,
  IconDots,
  IconExternalLink,
  IconRadar2,
  IconRoute,
} from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { StudioMenu } from '../../parts/menu';
import { text } from '../../text';
import { deskOf } from './desk';
import {
  setOption,
  toggleOption,
  trailLengths,
  useWorldOptions,
  type WorldOptions,
} from './options';
import { canSolid } from './webgl';

const words = text.world;
const size = { size: 14, stroke: kStroke };

/** What is drawn of a world, and how it is looked at. */
export function WorldTools({ panel = false }: { panel?: boolean }) {
  const studio = useStudio();
  const options = useWorldOptions();
  const run = (id: string) => () => void studio.registry.run(id);
  return (
    <div className="doctools">
      <Switch name="rays" tip={words.rays} icon={<IconRadar2 {...size} />} />
      <Switch name="trails" tip={words.trails} icon={<IconRoute {...size} />} />
      <Button
        kind="plain"
        small
        tip={canSolid() ? (options.solid ? words.flat : words.solid) : words.noSolid}
        aria-pressed={options.solid && canSolid()}
        aria-disabled={!canSolid()}
        className={options.solid && canSolid() ? 'is-on' : ''}
        icon={<IconCube {...size} />}
        onClick={() => canSolid() && toggleOption(studio, 'solid')}
      />
      <Button
        kind="plain"
        small
        tip={`${words.fit}  (1)`}
        icon={<IconArrowsMaximize {...size} />}
        onClick={() => deskOf(studio).shown?.model.fit()}
      />
      <StudioMenu
        position="bottom-end"
        button={
          <button
            type="button"
            className="btn btn--plain btn--small btn--icon"
            aria-label={words.look}
          >
            <IconDots {...size} />
          </button>
        }
      >
        <MoreItems options={options} />
      </StudioMenu>
      {panel ? (
        <Button
          kind="plain"
          small
          tip={words.open}
          icon={<IconExternalLink {...size} />}
          onClick={run('world.open')}
        />
      ) : null}
    </div>
  );
}

function MoreItems({ options }: { options: WorldOptions }) {
  const studio = useStudio();
  return (
    <>
      <Menu.Label>{words.look}</Menu.Label>
      {(['grid', 'picture', 'list'] as const).map((name) => (
        <Menu.Item
          key={name}
          role="menuitemcheckbox"
          aria-checked={options[name]}
          rightSection={options[name] ? '✓' : null}
          onClick={() => toggleOption(studio, name)}
        >
          {name === 'list' ? words.showList : words[name]}
        </Menu.Item>
      ))}
      <Menu.Divider />
      <Menu.Label>{words.trailLength}</Menu.Label>
      {trailLengths.map((length) => (
        <Menu.Item
          key={length}
          role="menuitemradio"
          aria-checked={options.trailLength === length}
          rightSection={options.trailLength === length ? '✓' : null}
          onClick={() => setOption(studio, { trailLength: length, trails: true })}
        >
          {words.trailOf(length)}
        </Menu.Item>
      ))}
      <Menu.Item onClick={() => studio.registry.run('world.clearTrails')}>
        {words.clearTrails}
      </Menu.Item>
    </>
  );
}

function Switch({ name, tip, icon }: { name: 'rays' | 'trails'; tip: string; icon: ReactNode }) {
  const studio = useStudio();
  const on = useWorldOptions()[name];
  return (
    <Button
      kind="plain"
      small
      tip={tip}
      icon={icon}
      aria-pressed={on}
      className={on ? 'is-on' : ''}
      onClick={() => toggleOption(studio, name)}
    />
  );
}

/** In the head of the panel. */
export default function WorldPanelTools() {
  return <WorldTools panel />;
}
