import { useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { text } from '../../../text';
import { drawWords } from '../words';

/** What to begin with; where the palette is not in sight, a button brings it. */
export function EmptyPlan() {
  const { registry } = useStudio();
  return (
    <div className="pcanvas__empty">
      <p>{drawWords.empty}</p>
      <Button small onClick={() => registry.run('panel.palette')}>
        {text.panel(text.panels.palette)}
      </Button>
    </div>
  );
}
