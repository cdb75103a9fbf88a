import { pickName, type Pick } from '../../../core/picks';
import { text } from '../../text';
import { PickButtons } from './pick_buttons';

const words = text.variables;

/** The node has no such variable now; it is kept, for it may come back with the next script. */
export function Missing({ pick, known }: { pick: Pick; known: boolean }) {
  return (
    <div className="variable variable--missing">
      <span className="variable__dot" aria-hidden />
      <code className="ellipsis">{pickName(pick)}</code>
      <span className="muted ellipsis">{known ? words.missing : words.waits}</span>
      <span />
      <PickButtons pick={pick} size={1} inWatch />
    </div>
  );
}
