import { IconMap2 } from '@tabler/icons-react';
import { Suspense, useRef } from 'react';
import type { WorldModel } from '../../core/world/model';
import type { Doc } from '../../protocol/messages';
import { useStudio, useTopic } from '../hooks';
import { Blank } from '../parts/blank';
import { kStroke } from '../parts/icons';
import { late } from '../parts/late';
import { useShown } from '../robot_hooks';
import { text } from '../text';
import { useDesk, useModel } from '../views/world/desk';
import {
  useFileStage,
  useHasScene,
  useJsonFile,
  useLive,
  useWorldModel,
} from '../views/world/use_world';
import { RunNotes } from '../views/world/run_notes';
import { SpeedBar } from '../views/world/speed_bar';
import { ThingList } from '../views/world/thing_list';
import { WorldStage } from '../views/world/world_stage';
import '../look/world.css';

const PressStrip = late(() => import('../views/world/press_strip'), 'button');

/** The world as it runs; while nothing runs, as its file says. */
export default function WorldPanel() {
  const runs = useHasScene();
  const world = useTopic('studio', {})?.project?.world;
  if (runs) return <Running />;
  if (world !== undefined) return <AsFile key={world} doc={world} />;
  return (
    <Blank
      title={text.world.noWorld}
      icon={<IconMap2 className="icon" size={18} stroke={kStroke} />}
    >
      {text.world.noWorldHelp}
    </Blank>
  );
}

function Running() {
  const frame = useRef<HTMLDivElement>(null);
  const model = useWorldModel();
  useLive(model, useShown(frame));
  return (
    <div className="world world--panel" ref={frame} data-world>
      <RunNotes />
      <WorldStage model={model} file={null} live>
        <div className="world__wide">
          <SpeedBar />
        </div>
        <Buttons model={model} />
      </WorldStage>
      <ThingList model={model} hidden />
    </div>
  );
}

/** Of the robot that is selected, where no form has them. */
function Buttons({ model }: { model: WorldModel }) {
  const desk = useDesk(useStudio());
  const { chosen } = useModel(model);
  if (desk.hasForm || chosen?.kind !== 'robot') return null;
  return (
    <Suspense>
      <PressStrip robot={chosen.name} />
    </Suspense>
  );
}

function AsFile({ doc }: { doc: Doc }) {
  const model = useWorldModel();
  const { file } = useJsonFile(doc);
  useFileStage(model, file, doc, false);
  return (
    <div className="world world--panel" data-world>
      <WorldStage model={model} file={null} live={false}>
        <p className="world__chip">{text.world.asFile}</p>
      </WorldStage>
      <ThingList model={model} hidden />
    </div>
  );
}
