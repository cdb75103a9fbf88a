import { useState } from 'react';
import { useDrives } from '../../hooks';
import { StudioPopover } from '../../parts/popover';
import { words } from './words';
import { NewTemplateForm } from './new_template_form';

/** "New template…" below the templates that there are. */
export function NewTemplateButton() {
  const drives = useDrives();
  const [isOpen, open] = useState(false);
  return (
    <StudioPopover
      label={words.newTemplate}
      opened={isOpen}
      onChange={open}
      position="right-end"
      width={300}
      button={
        <button
          type="button"
          className="btn btn--small palettepanel__variable"
          disabled={!drives}
          onClick={() => open(!isOpen)}
        >
          {words.newTemplate}
        </button>
      }
    >
      <NewTemplateForm onDone={() => open(false)} />
    </StudioPopover>
  );
}
