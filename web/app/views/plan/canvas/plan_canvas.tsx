import { Background, BackgroundVariant, ReactFlow, ReactFlowProvider } from '@xyflow/react';
import { useCallback, useRef, useState } from 'react';
import type { Doc } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { useMayEdit, useStudio } from '../../../hooks';
import { Blank } from '../../../parts/blank';
import { drawWords as words } from '../words';
import { useTriedClick } from '../try/try_commands';
import { Differences } from '../compare/differences';
import { Coverage } from '../coverage/coverage';
import { useBoard } from '../plan_desk';
import { usePlanOptions } from '../plan_options';
import { ActiveLine } from './active_line';
import { ArrowsLayer } from './arrows_layer';
import { useClicked, useKeptFocus, useNodeChanges, useNodes, useOnDesk } from './canvas_hooks';
import { CanvasContexts } from './canvas_contexts';
import { ConnectMenu } from './connect_menu';
import { kManyNodes, useAfterwards, useDistance } from './distance';
import { ElementMenu } from './element_menu';
import { EmptyPlan } from './empty_plan';
import { FindBar } from './find_bar';
import { kFit, useFirstView, useFitted } from './fitted';
import type { PlanNode } from './flow_nodes';
import { kFlowProps } from './flow_props';
import { nodeTypes } from './nodes';
import { Presented } from './presented';
import { SmallMap } from './small_map';
import { useClipboard } from './plan_clipboard';
import { useDropping } from './use_dropping';
import { useElementMenu } from './use_element_menu';
import { useConnecting } from './use_connecting';
import { usePlanBoard } from './use_board';
import '../../../look/draw.css';

/** A plan drawn: chosen, moved, connected by mouse and keyboard. */
export default function PlanCanvas({ doc }: { doc: Doc }) {
  const { board, failed } = usePlanBoard(doc);
  if (failed !== null) return <Blank title={words.failed}>{failed}</Blank>;
  if (!board) return null;
  return (
    <ReactFlowProvider>
      <Canvas key={doc} board={board} />
    </ReactFlowProvider>
  );
}

function Canvas({ board }: { board: PlanBoard }) {
  useBoard(board);
  const { broken, isKnown } = board.file;
  const drives = useMayEdit() && broken === null;
  const nodes = useNodes(board, drives);
  const distance = useDistance(nodes.length);
  const map = useAfterwards() || nodes.length <= kManyNodes;
  const frame = useRef<HTMLDivElement>(null);
  const keep = useKeptFocus(frame, nodes);
  const [finds, setFinds] = useState(false);
  const find = useCallback(() => setFinds(true), []);
  const worksOn = useFitted(board, frame);
  const view = useFirstView(board);
  const { shown, use } = useOnDesk(board, frame, { find, worksOn });
  const clipboard = useClipboard(useStudio(), shown, drives);
  const { connect, asked, close } = useConnecting(board, drives);
  const dropping = useDropping(board, drives);
  const { menu, closeMenu, ...menus } = useElementMenu(board);
  const options = usePlanOptions();
  const tries = useTriedClick(board);
  const clicked = useClicked(board);
  const onNodesChange = useNodeChanges(board);
  if (!isKnown) return <Blank title={words.broken}>{broken}</Blank>;
  return (
    <CanvasContexts board={board} drives={drives} distance={distance} connect={connect}>
      <div
        className="pcanvas"
        ref={frame}
        data-place="plan plan-parts"
        data-autofocus
        data-distance={distance}
        data-tries={tries !== null || undefined}
        tabIndex={-1}
        role="region"
        aria-label={words.canvas(board.model.name)}
        onPointerDownCapture={() => (use(), worksOn())}
        onKeyDownCapture={worksOn}
        onDropCapture={worksOn}
        onFocusCapture={use}
        onFocus={keep}
        {...dropping}
        {...clipboard}
      >
        <ReactFlow<PlanNode>
          {...kFlowProps}
          nodes={nodes}
          edges={kNoEdges}
          nodeTypes={nodeTypes}
          onNodesChange={onNodesChange}
          onMoveStart={(event) => event && worksOn()}
          onNodeClick={(event, { id }) => tries?.(event, id) || clicked(id, event)}
          {...menus}
          onPaneClick={() => {
            board.select(null);
            // Keys are for the plan that was clicked.
            frame.current?.focus({ preventScroll: true });
          }}
          fitView={!view}
          fitViewOptions={kFit}
          {...(view ? { defaultViewport: view } : {})}
          onlyRenderVisibleElements={nodes.length > kManyNodes}
          ariaLabelConfig={words.aria}
        >
          {distance === 'far' ? null : (
            <Background variant={BackgroundVariant.Dots} gap={24} size={1.5} />
          )}
          <ArrowsLayer board={board} allData={options.data} />
          <Differences board={board} />
          <Coverage board={board} />
          <Presented board={board} />
          {options.map && map ? <SmallMap board={board} /> : null}
        </ReactFlow>
        {broken === null ? null : <p className="pcanvas__locked">{words.locked}</p>}
        {board.drawing.isSketch && nodes.length > kManyNodes ? (
          <p className="pcanvas__locked">{board.isCut ? words.cut : words.sketched}</p>
        ) : null}
        {board.model.actors.length === 0 ? <EmptyPlan /> : null}
        {finds ? (
          <FindBar board={board} focus={shown.focus} onClose={() => setFinds(false)} />
        ) : null}
        {menu ? <ElementMenu at={menu} onClose={closeMenu} /> : null}
        {asked ? (
          <ConnectMenu board={board} asked={asked} onClose={close} onMade={shown.focus} />
        ) : null}
      </div>
      <ActiveLine board={board} onShow={(key) => (board.select(key), shown.focus(key))} />
    </CanvasContexts>
  );
}

const kNoEdges: never[] = [];
