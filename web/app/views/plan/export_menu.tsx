import { IconPhoto } from '@tabler/icons-react';
import { kStroke } from '../../parts/icons';
import { CommandItem, StudioMenu } from '../../parts/menu';
import { drawWords as words } from './words';

/** The drawing as a picture. */
export function ExportMenu() {
  return (
    <StudioMenu
      button={
        <button
          type="button"
          className="btn btn--plain btn--small btn--icon"
          aria-label={words.exportPicture}
          title={words.exportPicture}
        >
          <IconPhoto size={14} stroke={kStroke} aria-hidden />
        </button>
      }
    >
      <CommandItem id="draw.exportSvg" title={words.asSvg} />
      <CommandItem id="draw.exportPng" title={words.asPng} />
    </StudioMenu>
  );
}
