// The drawing as a file: SVG, or PNG drawn from it at twice its size.

import { pictureOf, type Picture } from '../../../../core/plan/picture';
import type { PictureLook } from '../../../../core/plan/picture_parts';
import { baseName } from '../../../../core/paths';
import type { Studio } from '../../../../core/studio';
import { download } from '../../../commands/download';
import { drawWords } from '../words';
import type { ShownPlan } from '../plan_desk';
import { planOptionsOf } from '../plan_options';

export function exportSvg(studio: Studio, plan: ShownPlan): void {
  const { svg } = pictured(studio, plan);
  download(new Blob([svg], { type: 'image/svg+xml' }), `${nameOf(plan)}.svg`);
}

export async function exportPng(studio: Studio, plan: ShownPlan): Promise<void> {
  const png = await drawn(pictured(studio, plan));
  download(png, `${nameOf(plan)}.png`);
}

/** WallFollow of examples/WallFollow.plan.json. */
const nameOf = ({ board }: ShownPlan) => baseName(board.doc).replace(/\.plan\.json$/, '');

/** In the theme that is looked at, with the data arrows if they are shown. */
function pictured(studio: Studio, { board }: ShownPlan): Picture {
  const { model, scene, drawing, notes } = board;
  const { data } = planOptionsOf(studio).getState();
  return pictureOf({ model, scene, drawing, notes, data, start: drawWords.start }, lookNow());
}

function lookNow(): PictureLook {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    canvas: colour('--surface-canvas'),
    raised: colour('--surface-raised'),
    panel: colour('--surface-panel'),
    bar: colour('--surface-bar'),
    border: colour('--border-hover'),
    borderStrong: colour('--border-strong'),
    text: colour('--text-primary'),
    secondary: colour('--text-secondary'),
    muted: colour('--text-muted'),
    arrow: colour('--action-arrow'),
    data: colour('--data-arrow'),
    error: colour('--error'),
  };
}

const kScale = 2;
/** Sides of a canvas that all browsers can draw. */
const kSideMax = 8192;

async function drawn({ svg, width, height }: Picture): Promise<Blob> {
  const url = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
  try {
    const image = new Image(width, height);
    image.src = url;
    await image.decode();
    const scale = Math.min(kScale, kSideMax / width, kSideMax / height);
    const canvas = document.createElement('canvas');
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
    const png = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
    if (!png) throw new Error(drawWords.noPicture);
    return png;
  } finally {
    URL.revokeObjectURL(url);
  }
}
