import { OverlayFrame, useCloseOverlay } from '../../parts/overlay_frame';
import { words } from './words';
import { NewTemplateForm } from './new_template_form';
import '../../look/palette.css';

/** The form of a new template over the window, from wherever one is. */
export default function NewTemplateSheet() {
  const close = useCloseOverlay();
  return (
    <OverlayFrame label={words.newTemplate}>
      <div className="sheet sheet--small">
        <div className="sheet__head">
          <h2>{words.title}</h2>
        </div>
        <NewTemplateForm onDone={close} />
      </div>
    </OverlayFrame>
  );
}
