import { IconCommand, IconContrast2, IconHelp } from '@tabler/icons-react';
import { useCommands, useFleetShown, useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke, Logo } from '../parts/icons';
import { text } from '../text';
import { Bus } from './bus';
import { Clock } from './clock';
import { FleetSwitch } from './fleet_switch';
import { LayoutSwitch } from './layout_switch';
import { Missing } from './missing';
import { ProjectMenu } from './project_menu';
import { RunControls } from './run_controls';
import { TargetMenu } from './target_menu';

/** Where am I, what does the robot do, where does it run. */
export function TopBar() {
  const opened = useTopic('studio', {})?.project;
  const project = useFleetShown() ? undefined : opened;
  return (
    <header className="topbar" data-region="top" aria-label={text.regions.top}>
      <div className="brand">
        <Logo />
        <span>{text.name}</span>
      </div>
      <FleetSwitch project={opened?.name ?? null} />
      {project ? (
        <>
          <ProjectMenu name={project.name} />
          <LayoutSwitch />
          <RunControls />
          <Clock />
        </>
      ) : null}
      <div className="grow" />
      {project ? <Missing /> : null}
      <TargetMenu />
      {project ? <Bus /> : null}
      <Tools />
    </header>
  );
}

function Tools() {
  const { registry } = useStudio();
  useCommands();
  const size = { size: 16, stroke: kStroke };
  return (
    <div className="topbar__tools">
      <Button
        kind="plain"
        tip={text.commands['palette.open']}
        keys="Ctrl+K"
        icon={<IconCommand {...size} />}
        onClick={() => registry.run('palette.open')}
      />
      <Button
        kind="plain"
        tip={text.commands['theme.next']}
        icon={<IconContrast2 {...size} />}
        onClick={() => registry.run('theme.next')}
      />
      <Button
        kind="plain"
        tip={text.commands['help.open']}
        keys="F1"
        icon={<IconHelp {...size} />}
        onClick={() => registry.run('help.open')}
      />
    </div>
  );
}
