import { useStudio } from '../hooks';
import { Button } from '../parts/button';
import { text } from '../text';

/** The run goes on from the instant that is looked back at, with what was changed. */
export function RunFromHere() {
  const { registry } = useStudio();
  return (
    <Button
      small
      disabled={!registry.isEnabled('past.continue')}
      onClick={() => void registry.run('past.continue')}
    >
      {text.commands['past.continue']}
    </Button>
  );
}
