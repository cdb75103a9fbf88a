import { testOptionsOf } from '../../../core/tests';
import { revealDoc } from '../../../core/window_state';
import type { CoverageRow, Path } from '../../../protocol/messages';
import { documentsIn } from '../../documents';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { coverageWords as words } from '../../views/tests/words';

/** Of each plan and each file of scripts: how much was ever taken. */
export function CoverageTable({ rows }: { rows: readonly CoverageRow[] }) {
  const studio = useStudio();
  const show = (path: Path) => {
    testOptionsOf(studio).toggle('coverage', true);
    const [doc = path] = documentsIn(studio, path);
    revealDoc(studio.window, doc, null);
  };
  return (
    <section className="tests__coverage" aria-label={words.title}>
      <h3>{words.title}</h3>
      {rows.map(({ path, kinds }) => (
        <div className="tests__file" key={path}>
          <b className="ellipsis">{path}</b>
          <dl className="tests__kinds">
            {kinds.map(({ name, taken, of }) => (
              <div key={name}>
                <dt>{words.kinds[name]}</dt>
                <dd className="num">{words.share(taken, of)}</dd>
                <Share taken={taken} of={of} />
              </div>
            ))}
          </dl>
          <Button small kind="plain" aria-label={words.showIn(path)} onClick={() => show(path)}>
            {words.show}
          </Button>
        </div>
      ))}
    </section>
  );
}

/** The same as a bar; its number is beside it. */
function Share({ taken, of }: { taken: number; of: number }) {
  return <meter className="tests__share" min={0} max={Math.max(of, 1)} value={taken} aria-hidden />;
}
