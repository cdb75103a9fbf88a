import { Suspense, useMemo, useRef } from 'react';
import { late } from '../../parts/late';
import type { Doc, Finding } from '../../../protocol/messages';
import { Blank } from '../../parts/blank';
import { Button } from '../../parts/button';
import { text } from '../../text';
import { useShown } from '../../robot_hooks';
import { FindingNotice } from '../finding_notice';
import { DiskNotice } from '../script/script_notices';
import type { ShownWorld } from './desk';
import { EditTools, RunTools } from './edit_tools';
import { useWorldOptions } from './options';
import { ModeNote, RunNotes } from './run_notes';
import { SpeedBar } from './speed_bar';
import { useMode } from './use_mode';
import {
  useBroken,
  useFileStage,
  useHasScene,
  useJsonFile,
  useLive,
  useWorldModel,
} from './use_world';
import { keyMeant } from '../../../core/world/file';
import type { WorldModel } from '../../../core/world/model';
import { WorldSide } from './world_side';
import { WorldStage } from './world_stage';
import { WorldTools } from './world_tools';
import '../../look/world.css';
import { formWords } from './form_words';

const ScriptView = late(() => import('../script/script_view'));

/** A world: as it runs, as its file says and is edited, or its text. */
export default function WorldDocument({ doc }: { doc: Doc }) {
  const runs = useHasScene();
  const { mode, choose, modes } = useMode(doc);
  if (mode === 'text')
    return (
      <div className="world" data-world>
        <div className="world__bar">{modes}</div>
        <Suspense fallback={null}>
          <ScriptView doc={doc} isScript={false} />
        </Suspense>
      </div>
    );
  return mode === 'live' ? (
    <LiveWorld modes={modes} runs={runs} onEdit={() => choose('edit')} />
  ) : (
    <EditedWorld key={doc} doc={doc} modes={modes} onText={() => choose('text')} />
  );
}

function LiveWorld(props: { modes: React.ReactNode; runs: boolean; onEdit: () => void }) {
  const { modes, runs, onEdit } = props;
  const frame = useRef<HTMLDivElement>(null);
  const model = useWorldModel();
  const visible = useShown(frame);
  const { list } = useWorldOptions();
  useLive(model, visible);
  const world = useMemo<ShownWorld>(() => ({ model, file: null, focus() {} }), [model]);
  return (
    <div className="world" ref={frame} data-world>
      <div className="world__bar">
        {modes}
        {runs ? <RunTools /> : null}
        <span className="grow" />
        <SpeedBar />
        <WorldTools />
      </div>
      <ModeNote mode="live" />
      <RunNotes />
      {runs ? (
        <div className="world__main">
          <WorldStage model={model} file={null} live />
          {list ? <WorldSide world={world} /> : null}
        </div>
      ) : (
        <Blank title={formWords.notRunning}>
          <p>{formWords.notRunningHelp}</p>
          <Button onClick={onEdit}>{formWords.editIt}</Button>
        </Blank>
      )}
    </div>
  );
}

function EditedWorld(props: { doc: Doc; modes: React.ReactNode; onText: () => void }) {
  const { doc, modes, onText } = props;
  const model = useWorldModel();
  const { file, failed } = useJsonFile(doc);
  const { list } = useWorldOptions();
  const broken = useBroken(file);
  useFileStage(model, file, doc, broken === null);
  const world = useMemo<ShownWorld>(() => ({ model, file, focus() {} }), [model, file]);
  return (
    <div className="world" data-world>
      <div className="world__bar">
        {modes}
        {file ? <EditTools file={file} /> : null}
        <span className="grow" />
        <WorldTools />
      </div>
      <ModeNote mode="edit" />
      <DiskNotice doc={doc} />
      {broken === null ? null : <p className="notice">{formWords.locked}</p>}
      <FindingNotice doc={doc} onShow={(finding) => showFound(model, finding)} />
      {failed || (file && !file.isKnown) ? (
        <Blank title={failed ? formWords.failed : formWords.broken}>
          <p>{failed ?? broken}</p>
          <Button onClick={onText}>{text.world.showText}</Button>
        </Blank>
      ) : (
        <div className="world__main">
          <WorldStage model={model} file={file} live={false} />
          {list ? <WorldSide world={world} /> : null}
        </div>
      )}
    </div>
  );
}

/** Chooses the thing or entry that a finding is about. */
function showFound(model: WorldModel, { element, what }: Finding): boolean {
  const key = keyMeant(element ?? what) ?? keyMeant(what);
  if (key === null) return false;
  if (model.thing(key)) model.select(key);
  else model.selectEntry(key.startsWith('timeline/') ? key : null);
  return true;
}
