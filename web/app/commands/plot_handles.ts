// The plot that is shown, so that a command can take a picture of it.

import type { Studio } from '../../core/studio';

const pictures = new WeakMap<Studio, () => Promise<Blob | null>>();

export function showPlot(studio: Studio, picture: () => Promise<Blob | null>): () => void {
  pictures.set(studio, picture);
  return () => void (pictures.get(studio) === picture && pictures.delete(studio));
}

export async function plotPicture(studio: Studio): Promise<Blob | null> {
  return (await pictures.get(studio)?.()) ?? null;
}
