// A plot as a picture: the drawing with the names of its curves below.

import type uPlot from 'uplot';
import type { Plotter } from '../../../core/plotter';
import { dashes } from './chart';

const kLine = 20;
const kColumn = 220;

export async function pictureOfPlot(
  plot: uPlot,
  plotter: Plotter,
  place: HTMLElement,
): Promise<Blob | null> {
  const drawn = plot.ctx.canvas;
  const scale = drawn.width / plot.width;
  const { curves } = plotter.state;
  const columns = Math.max(1, Math.floor((plot.width - 16) / kColumn));
  const canvas = document.createElement('canvas');
  canvas.width = drawn.width;
  canvas.height = drawn.height + (Math.ceil(curves.length / columns) * kLine + 12) * scale;
  const to = canvas.getContext('2d');
  if (!to) return null;
  const style = getComputedStyle(place);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  to.fillStyle = colour('--surface-panel');
  to.fillRect(0, 0, canvas.width, canvas.height);
  to.drawImage(drawn, 0, 0);
  to.scale(scale, scale);
  to.font = '12px "JetBrains Mono Variable", monospace';
  to.textBaseline = 'middle';
  curves.forEach(({ source, colour: number }, index) => {
    const x = 16 + (index % columns) * kColumn;
    const y = plot.height + 6 + (Math.floor(index / columns) + 0.5) * kLine;
    to.strokeStyle = colour(`--curve-${number + 1}`);
    to.lineWidth = 2;
    to.setLineDash([...(dashes[number] ?? [])]);
    to.beginPath();
    to.moveTo(x, y);
    to.lineTo(x + 24, y);
    to.stroke();
    to.fillStyle = colour('--text-primary');
    to.fillText(plotter.nameOf(source), x + 32, y, kColumn - 44);
  });
  return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
}
