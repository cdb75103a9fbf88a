// Whether this browser can draw in 3D: asked once.

let known: boolean | null = null;

export function canSolid(): boolean {
  known ??= asked();
  return known;
}

function asked(): boolean {
  try {
    const context = document.createElement('canvas').getContext('webgl2');
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    return context !== null;
  } catch {
    return false;
  }
}
