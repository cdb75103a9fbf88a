// Indentation from the lines above: one step in behind what opens, one out at what closes. It does
// not need a whole text, so it works while one is written.

const opens = /^\s*(onevent|sub|if|elseif|else|while|for|when)\b/;
const closes = /^\s*(end|else|elseif)\b/;
const heads = /^\s*(onevent|sub)\b/;
const endsInLine = /\bend\s*$/;

/** The columns of indentation of a line, given the code lines above it, nearest last. */
export function indentOf(above: readonly string[], line: string, step: number): number {
  if (heads.test(line)) return 0;
  const before = above.findLast((one) => bare(one).trim() !== '');
  if (before === undefined) return 0;
  const code = bare(before);
  const inner = opens.test(code) && !endsInLine.test(code) ? step : 0;
  return Math.max(0, widthOf(before, step) + inner - (closes.test(line) ? step : 0));
}

function bare(line: string): string {
  return line.replace(/#.*$/, '');
}

/** A tab goes to the next multiple of the step. */
function widthOf(line: string, step: number): number {
  let width = 0;
  for (const letter of line) {
    if (letter === ' ') width++;
    else if (letter === '\t') width += step - (width % step);
    else break;
  }
  return width;
}
