import { useStudio } from '../../hooks';
import { useTraceOpen } from '../../past_hooks';
import { words } from './words';

/** Whose plan a recording of several robots shows; the instant stays. */
export function RobotChoice() {
  const studio = useStudio();
  const trace = useTraceOpen();
  if (!trace || trace.robots.length < 2) return null;
  const choose = (robot: string) =>
    studio.past
      .openTrace(trace.path, robot, studio.past.at ?? undefined)
      .catch((problem: unknown) => studio.tell(problem));
  return (
    <select
      className="field field--ui field--small tl__robot"
      aria-label={words.planOf}
      title={words.planOf}
      value={trace.robot ?? ''}
      onChange={(event) => void choose(event.target.value)}
    >
      {trace.robots.map((robot) => (
        <option key={robot}>{robot}</option>
      ))}
    </select>
  );
}
