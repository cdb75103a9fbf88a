import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconChevronRight,
  IconLayoutDistributeVertical,
  IconPlus,
} from '@tabler/icons-react';
import { useCallback, useEffect, useReducer, useSyncExternalStore } from 'react';
import type { Doc } from '../../../protocol/messages';
import { revealDoc } from '../../../core/window_state';
import { useDrives, useStudio, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { drawWords as words } from './words';
import { CompareMenu } from './compare/compare_menu';
import { CoverageOfTests } from './coverage/coverage';
import { ExportMenu } from './export_menu';
import { usePlanDesk } from './plan_desk';
import { TryButton } from './try/try_button';
import { togglePlanOption, usePlanOptions, type PlanOptions } from './plan_options';
import { keysShown } from '../../parts/keys_shown';

const size = { size: 14, stroke: kStroke };

/** Above the drawing: undo, and what is shown beside and in it. */
export function PlanTools({ doc }: { doc: Doc }) {
  const studio = useStudio();
  const drives = useDrives();
  const { shown } = usePlanDesk(studio);
  const file = shown?.board.doc === doc ? shown.board.file : undefined;
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => file?.changed.on(redraw), [file]);
  return (
    <div className="plan__bar" data-place="plan-parts">
      <Back doc={doc} />
      <Button
        kind="plain"
        small
        disabled={!drives || !file?.canUndo}
        tip={`${words.undo}  (${keysShown('Ctrl+Z')})`}
        icon={<IconArrowBackUp {...size} />}
        onClick={() => void studio.registry.run('draw.undo')}
      />
      <Button
        kind="plain"
        small
        disabled={!drives || !file?.canRedo}
        tip={`${words.redo}  (${keysShown('Ctrl+Y')})`}
        icon={<IconArrowForwardUp {...size} />}
        onClick={() => void studio.registry.run('draw.redo')}
      />
      <Button
        kind="plain"
        small
        disabled={!drives || !file}
        tip={`${text.commands['draw.add']}  (A)`}
        icon={<IconPlus {...size} />}
        onClick={() => void studio.registry.run('draw.add')}
      >
        {words.add}
      </Button>
      <ExportMenu />
      <CompareMenu doc={doc} />
      <Button
        kind="plain"
        small
        disabled={!drives || !file}
        tip={`${text.commands['draw.tidy']}  (T)`}
        icon={<IconLayoutDistributeVertical {...size} />}
        onClick={() => void studio.registry.run('draw.tidy')}
      >
        {words.tidy}
      </Button>
      <TryButton doc={doc} />
      <Zoom doc={doc} />
      <span className="grow" />
      <CoverageOfTests doc={doc} />
      <Switch name="data" />
      <Switch name="map" />
      <Switch name="text" />
      <Switch name="code" />
      <Switch name="live" />
    </div>
  );
}

/** In per cent; pressed, it is 100 %. */
function Zoom({ doc }: { doc: Doc }) {
  const { shown } = usePlanDesk(useStudio());
  const own = shown?.board.doc === doc ? shown : undefined;
  const zoom = useSyncExternalStore(
    useCallback((listener: () => void) => own?.zoomed.on(listener) ?? (() => {}), [own]),
    () => own?.zoom() ?? 1,
  );
  return (
    <Button
      kind="plain"
      small
      disabled={!own}
      tip={words.zoomTo}
      aria-label={words.zoom(Math.round(zoom * 100))}
      onClick={() => own?.zoomTo(1)}
    >
      <span className="num">{Math.round(zoom * 100)} %</span>
    </Button>
  );
}

/** From a sub-plan to the plan from which it was opened. */
function Back({ doc }: { doc: Doc }) {
  const studio = useStudio();
  const caller = useWindow((window) => window.callers[doc]);
  if (caller === undefined) return null;
  const name = (of: Doc) => of.replace(/^.*\//, '').replace(/\.plan\.json$/, '');
  return (
    <nav className="plan__back" aria-label={words.subPlans.back(name(caller))}>
      <button
        type="button"
        className="plan__caller"
        title={words.subPlans.back(name(caller))}
        onClick={() => revealDoc(studio.window, caller, null)}
      >
        {name(caller)}
      </button>
      <IconChevronRight {...size} aria-hidden />
      <b className="ellipsis">{name(doc)}</b>
    </nav>
  );
}

function Switch({ name }: { name: keyof PlanOptions }) {
  const studio = useStudio();
  const options = usePlanOptions();
  return (
    <button
      type="button"
      role="switch"
      className="switch"
      aria-checked={options[name]}
      onClick={() => togglePlanOption(studio, name)}
    >
      {words.switches[name]}
    </button>
  );
}
