import { testOptionsOf } from '../../../core/tests';
import { useChanges, useStudio } from '../../hooks';
import { coverageWords as words } from './words';

/** The same for all plans and scripts of the window. */
export function CoverageSwitch() {
  const options = testOptionsOf(useStudio());
  useChanges(options.changed);
  return (
    <button
      type="button"
      role="switch"
      className="switch"
      aria-checked={options.coverage}
      onClick={() => options.toggle('coverage')}
    >
      {words.show}
    </button>
  );
}
