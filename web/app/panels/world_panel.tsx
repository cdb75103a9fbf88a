import { IconMap2 } from '@tabler/icons-react';
import { useRef } from 'react';
import type { Doc } from '../../protocol/messages';
import { useTopic } from '../hooks';
import { Blank } from '../parts/blank';
import { kStroke } from '../parts/icons';
import { useShown } from '../robot_hooks';
import { text } from '../text';
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
      </WorldStage>
      <ThingList model={model} hidden />
    </div>
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
