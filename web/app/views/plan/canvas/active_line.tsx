import { aheadText, inputsAhead } from '../../../../core/plan/ahead';
import type { PlanBoard } from '../../../../core/plan/board';
import { askWhy } from '../../../commands/ask_why';
import { useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { text } from '../../../text';
import { useBoard } from '../plan_desk';
import { useTriedPlan } from '../try/use_trying';
import { drawWords } from '../words';
import { useLive } from './live_store';

const words = drawWords.active;

/** Below the drawing while the plan runs: who works, and what its formulas gave. */
export function ActiveLine({ board, onShow }: { board: PlanBoard; onShow: (key: string) => void }) {
  const actor = useLive((live) => live.actor);
  const activation = useLive((live) => live.activation);
  const inputs = useLive((live) => live.inputs);
  const values = useLive((live) => live.values);
  const { model } = useBoard(board);
  const studio = useStudio();
  const isTried = useTriedPlan() !== null;
  if (actor === '') return null;
  const element = model.actors.find((one) => one.name === actor);
  const known = element?.known?.inputs ?? [];
  const unitOf = (name: string) => known.find((one) => one.name === name)?.unit ?? '';
  return (
    <footer className="pactive" aria-label={words.label}>
      <button
        type="button"
        className="pactive__actor"
        aria-label={words.show(actor)}
        onClick={() => onShow(actor)}
      >
        ▶ {actor}
      </button>
      <span className="muted">{words.activation(activation)}</span>
      <span className="pactive__inputs ellipsis">
        {inputs.size > 0
          ? [...inputs]
              .map(([name, value]) => `${name} ${value} ${unitOf(name)}`.trim())
              .join(' · ')
          : aheadText(inputsAhead(element), values)}
      </span>
      <span className="grow" />
      {isTried ? null : (
        <Button kind="plain" small onClick={() => void askWhy(studio, 'actor', actor)}>
          {text.why.row(actor)}
        </Button>
      )}
    </footer>
  );
}
