import { useTopic } from '../../hooks';

/** The name of the world that runs, beside the title of its panel; no part of the tab's own name. */
export default function WorldName() {
  const name = useTopic('scene', {})?.name;
  return name ? <span className="paneltitle__note" data-note={name} /> : null;
}
