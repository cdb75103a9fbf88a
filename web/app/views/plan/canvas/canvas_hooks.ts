// What joins a canvas to its board: nodes, moves, and the desk that palette and forms work on.

import { useReactFlow, useStore, type NodeChange } from '@xyflow/react';
import { useCallback, useEffect, useLayoutEffect, useMemo, useRef, useState } from 'react';
import { Emitter } from '../../../../core/emitter';
import type { PlanBoard } from '../../../../core/plan/board';
import { overlaps, type Box, type Point } from '../../../../core/plan/shape';
import { revealPanel, update } from '../../../../core/window_state';
import { useStudio, useTopic, useWindow } from '../../../hooks';
import { planDeskOf, type ShownPlan } from '../plan_desk';
import { compareCommands } from '../compare/compare_commands';
import { drawnHelp } from '../finding_acts';
import { tryCommands } from '../try/try_commands';
import { drawnHelpOf } from '../../../commands/problem_commands';
import { canvasCommands } from './canvas_commands';
import { kLegible } from './distance';
import { debugCommands } from './debug_commands';
import { kFit } from './fitted';
import { FlowNodes, type PlanNode } from './flow_nodes';

export function useNodes(board: PlanBoard, drives: boolean): PlanNode[] {
  const [made] = useState(() => new FlowNodes());
  const all = useTopic('findings', {})?.findings;
  const findings = useMemo(
    () => (all ?? []).filter((one) => one.doc === board.doc),
    [all, board.doc],
  );
  const version = board.changed.count;
  // Too small to be read from the last row.
  const pills = useWindow((state) => state.layout !== 'Present');
  return useMemo(() => {
    const all = version >= 0 ? made.of(board, findings, drives) : [];
    return pills ? all : all.filter((node) => node.type !== 'pill');
  }, [made, board, version, findings, drives, pills]);
}

/** What is chosen, and moves by mouse and arrow keys; each move becomes one edit when it has ended. */
export function useNodeChanges(board: PlanBoard) {
  return useCallback(
    (changes: NodeChange<PlanNode>[]) => {
      choose(board, changes);
      const moves = changes.flatMap((one) => (one.type === 'position' ? one : []));
      const places = moves.flatMap(({ id, position }): [string, Point][] =>
        position ? [[id, position]] : [],
      );
      if (places.length === 0) return;
      board.hold(places);
      if (!moves.some((one) => one.dragging)) board.letGo();
    },
    [board],
  );
}

function choose(board: PlanBoard, changes: readonly NodeChange<PlanNode>[]): void {
  const chosen = changes.flatMap((one) => (one.type === 'select' ? one : []));
  if (chosen.length === 0) return;
  const gone = new Set(chosen.flatMap((one) => (one.selected ? [] : one.id)));
  const come = chosen.flatMap((one) => (one.selected ? one.id : []));
  const isArrow = (key: string) => board.arrow(key) !== undefined;
  const kept = [...board.selection].filter(
    (key) => !gone.has(key) && !(come.length > 0 && isArrow(key)),
  );
  board.selectAll([...kept, ...come]);
}

/**
 * A click on one of several that are chosen means this one: the library would leave all of them chosen.
 * Its form comes in place of an answer about something else.
 */
export function useClicked(board: PlanBoard) {
  const studio = useStudio();
  return (key: string, event: React.MouseEvent) => {
    const adds = event.ctrlKey || event.metaKey || event.shiftKey;
    if (!adds && board.selection.size > 1 && board.selection.has(key)) board.select(key);
    revealPanel(studio.window, 'properties', false, 'why');
  };
}

/** What is seen of the plan. */
export function roomOf(flow: ReturnType<typeof useReactFlow>, frame: HTMLElement): Box {
  const { left, top, right, bottom } = frame.getBoundingClientRect();
  const first = flow.screenToFlowPosition({ x: left, y: top });
  const last = flow.screenToFlowPosition({ x: right, y: bottom });
  return { ...first, width: last.x - first.x, height: last.y - first.y };
}

/** Moves what is seen if an element is outside of it. */
function reveal(
  flow: ReturnType<typeof useReactFlow>,
  box: Box | undefined,
  frame: HTMLElement | null,
): void {
  if (!box || !frame) return;
  const room = roomOf(flow, frame);
  const { x, y, width, height } = box;
  const isSeen =
    x >= room.x &&
    y >= room.y &&
    x + width <= room.x + room.width &&
    y + height <= room.y + room.height;
  if (!isSeen)
    void flow.setCenter(x + width / 2, y + height / 2, {
      zoom: Math.max(flow.getZoom(), kLegible),
    });
}

/** What had the keyboard may go, by undo for instance: then the canvas has it, and its keys still work. */
export function useKeptFocus(frame: React.RefObject<HTMLDivElement | null>, nodes: unknown) {
  const last = useRef<Element | null>(null);
  useEffect(() => {
    // The canvas draws them after this.
    const asked = requestAnimationFrame(() => {
      const lost = document.activeElement === document.body && last.current?.isConnected === false;
      if (lost) frame.current?.focus({ preventScroll: true });
    });
    return () => cancelAnimationFrame(asked);
  }, [frame, nodes]);
  return useCallback((event: React.FocusEvent) => void (last.current = event.target), []);
}

/** Palette, forms and commands work on this canvas once it is used. */
export function useOnDesk(
  board: PlanBoard,
  frame: React.RefObject<HTMLDivElement | null>,
  { find, worksOn }: { find: () => void; worksOn: () => void },
) {
  const studio = useStudio();
  const flow = useReactFlow();
  const [zoomed] = useState(() => new Emitter<void>());
  const zoom = useStore(({ transform }) => transform[2]);
  useEffect(() => zoomed.emit(), [zoomed, zoom]);
  const shown = useMemo<ShownPlan>(
    () => ({
      board,
      zoom: () => flow.getZoom(),
      zoomed,
      zoomTo(zoom) {
        worksOn();
        void flow.zoomTo(zoom);
      },
      middle() {
        const { left, top, width, height } =
          frame.current?.getBoundingClientRect() ?? new DOMRect();
        return flow.screenToFlowPosition({ x: left + width / 2 - 84, y: top + height / 3 });
      },
      room: () =>
        frame.current ? roomOf(flow, frame.current) : { x: 0, y: 0, width: 0, height: 0 },
      show(key) {
        worksOn();
        reveal(flow, board.boxOf(key), frame.current);
      },
      showBox(box) {
        worksOn();
        reveal(flow, box, frame.current);
      },
      focus(key, { stays = false } = {}) {
        worksOn();
        const box = board.boxOf(key);
        const isStill = stays && box && frame.current && overlaps(box, roomOf(flow, frame.current));
        if (!isStill) reveal(flow, box, frame.current);
        requestAnimationFrame(() =>
          frame.current
            ?.querySelector<HTMLElement>(`.react-flow__node[data-id="${CSS.escape(key)}"]`)
            ?.focus(),
        );
      },
    }),
    [board, flow, frame, zoomed, worksOn],
  );
  // Before it can have the focus, which says that it is used.
  useLayoutEffect(() => planDeskOf(studio).add(shown), [studio, shown]);
  useEffect(() => {
    drawnHelpOf(studio).help ??= drawnHelp(studio);
    const properties = () => revealPanel(studio.window, 'properties');
    return studio.registry.add([
      ...debugCommands(studio, properties),
      ...compareCommands(studio),
      ...tryCommands(studio),
      ...canvasCommands(studio, {
        fit: () => void flow.fitView(kFit),
        zoom(by) {
          worksOn();
          void flow.zoomTo(flow.getZoom() * by);
        },
        properties,
        rename() {
          const { board } = shown;
          // A note is written where it is.
          if (!board.note(board.selected)) revealPanel(studio.window, 'properties', false);
          planDeskOf(studio).rename();
        },
        find,
      }),
    ]);
  }, [studio, shown, flow, find, worksOn]);
  const use = useCallback(() => {
    planDeskOf(studio).use(shown);
    const { doc } = shown.board;
    if (studio.window.getState().doc !== doc)
      update(studio.window, (draft) => void (draft.doc = doc));
  }, [studio, shown]);
  return { shown, use };
}
