import { formWords } from './form_words';
import { ButtonRow } from './press_buttons';

/** Over a picture that has no form beside it: a script that waits for a button can be tried there, too. */
export default function PressStrip({ robot }: { robot: string }) {
  return (
    <div className="world__press" role="group" aria-label={formWords.buttons}>
      <ButtonRow robot={robot} />
    </div>
  );
}
