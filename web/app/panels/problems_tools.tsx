import { useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { text } from '../text';

export default function ProblemsTools() {
  const { registry } = useStudio();
  const some = (useTopic('findings', {})?.findings.length ?? 0) > 0;
  return (
    <Button
      kind="plain"
      small
      keys="F4"
      disabled={!some}
      onClick={() => registry.run('problem.next')}
    >
      {text.problems.next}
    </Button>
  );
}
