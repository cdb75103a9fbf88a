import { IconX } from '@tabler/icons-react';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { KeysList } from '../parts/keys_list';
import { text } from '../text';
import { OverlayFrame, useCloseOverlay } from '../parts/overlay_frame';

/** The keys, over the window. */
export default function KeysHelp() {
  const close = useCloseOverlay();
  return (
    <OverlayFrame label={text.overlay.keys}>
      <div className="sheet">
        <div className="sheet__head">
          <h2>{text.overlay.keys}</h2>
          <Button
            autoFocus
            kind="plain"
            tip={text.overlay.close}
            icon={<IconX size={16} stroke={kStroke} />}
            onClick={close}
          />
        </div>
        <KeysList />
      </div>
    </OverlayFrame>
  );
}
