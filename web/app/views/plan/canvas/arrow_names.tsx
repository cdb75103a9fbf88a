import { EdgeLabelRenderer, useStore } from '@xyflow/react';
import type { PlanBoard } from '../../../../core/plan/board';
import { nameSpot } from '../../../../core/plan/strokes';
import { useWindow } from '../../../hooks';
import { useBoard } from '../plan_desk';
import { useLive } from './live_store';

/** The names of the arrow that is chosen and of the one that was taken last, above everything. */
export function ArrowNames({ board }: { board: PlanBoard }) {
  const { selected } = useBoard(board);
  const taken = useLive((live) => live.taken);
  return (
    <EdgeLabelRenderer>
      {selected === null ? null : <ArrowName board={board} id={selected} is="near" />}
      {taken === null || taken === selected ? null : (
        <ArrowName board={board} id={taken} is="taken" />
      )}
    </EdgeLabelRenderer>
  );
}

/** However small the drawing is, its letters are not smaller than those of a form. */
function ArrowName(props: { board: PlanBoard; id: string; is: 'near' | 'taken' }) {
  const { board, id, is } = props;
  const near = useStore(({ transform: [, , zoom] }) => 1 / zoom);
  const scale = Math.max(1, near);
  const route = board.drawing.routes.get(id);
  const name = board.arrow(id)?.outcome ?? '';
  const letters = useWindow(({ layout }) => layout === 'Present') ? kPresented * near : scale;
  const room = { size: sizeOf(name, letters), boxes: boxesOf(board) };
  const spot = route && nameSpot(route, room);
  if (!spot || name === '') return null;
  const transform = `translate(${spot.x}px, ${spot.y}px) scale(${scale}) translate(-50%, -50%)`;
  return (
    <span className={`parrow-name parrow-name--${is}`} style={{ transform }} aria-hidden>
      {name}
    </span>
  );
}

const boxesOf = ({ scene: { start, actors }, drawing }: PlanBoard) => [
  ...[start, ...actors].map((block) => block.whole),
  ...drawing.tags.map((tag) => tag.box),
];

/** On the canvas; letters are not wider than kLetter. */
function sizeOf(name: string, scale: number): { width: number; height: number } {
  return { width: (name.length * kLetter + kPadding) * scale, height: kHeight * scale };
}

const kLetter = 6.2;
/** As large as look/present.css has them, on the screen. */
const kPresented = 20 / 11;
const kPadding = 14;
const kHeight = 20;
