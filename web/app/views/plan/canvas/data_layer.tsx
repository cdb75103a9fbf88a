import { supervisorKey } from '../../../../core/plan/arrows';
import { pillKey, type PlanBoard } from '../../../../core/plan/board';
import { dataArrows, type DataArrow } from '../../../../core/plan/data';
import { supervisorsOf, type Actor, type Supervisor } from '../../../../core/plan/model';
import type { Box } from '../../../../core/plan/shape';
import { dataPath } from '../../../../core/plan/strokes';
import { drawWords } from '../words';
import { useLive } from './live_store';

/** Thin arrows from variables to inputs and back: of what is selected, or all. */
export function DataArrows({ board, all }: { board: PlanBoard; all: boolean }) {
  const elements = all ? everything(board) : chosen(board);
  const boxes = boxesOf(board);
  const pills = new Map(board.scene.pills.map(({ name, box }) => [name, box]));
  return (
    <g className="pdata">
      {elements.flatMap(([key, element]) =>
        dataArrows(board.model, element).map((arrow, index) => {
          const box = boxes.get(key);
          const pill = pills.get(arrow.variable);
          if (!box || !pill || !isMeant(board, arrow, key, all)) return null;
          const id = `${key} ${arrow.port} ${arrow.variable}`;
          return <Thin key={id} arrow={arrow} box={box} pill={pill} index={index} />;
        }),
      )}
    </g>
  );
}

type Named = readonly [string, Actor | Supervisor];

function everything(board: PlanBoard): Named[] {
  return [
    ...board.model.actors.map((actor): Named => [actor.name, actor]),
    ...supervisorsOf(board.model).map((one): Named => [supervisorKey(one), one]),
  ];
}

/** An element with all its arrows; of a variable those that have to do with it. */
function chosen(board: PlanBoard): Named[] {
  const { selected } = board;
  const element = board.element(selected);
  if (element && selected !== null) return [[selected, element]];
  return board.variable(selected) ? everything(board) : [];
}

function isMeant(board: PlanBoard, arrow: DataArrow, key: string, all: boolean): boolean {
  return all || key === board.selected || pillKey(arrow.variable) === board.selected;
}

function boxesOf(board: PlanBoard): Map<string, Box> {
  const { start, actors } = board.scene;
  return new Map([
    ...actors.map(({ name, box }): [string, Box] => [name, box]),
    ...[start, ...actors].flatMap((block) =>
      block.supervisors.map(({ supervisor, box }): [string, Box] => [
        supervisorKey(supervisor),
        box,
      ]),
    ),
  ]);
}

function Thin(props: { arrow: DataArrow; box: Box; pill: Box; index: number }) {
  const { arrow, box, pill, index } = props;
  const value = useLive((live) => live.values.get(arrow.variable));
  const gave = useLive((live) =>
    arrow.is === 'in' && live.actor === arrow.element ? live.inputs.get(arrow.port) : undefined,
  );
  const label = drawWords.dataNow(arrow, value, gave);
  const { line, head } = dataPath(arrow, box, pill, index);
  return (
    <g role="img" aria-label={label}>
      <title>{label}</title>
      <path className="pdata__hand" d={line} />
      <path className="pdata__line" d={line} />
      <path className="pdata__head" d={head} />
    </g>
  );
}
