/** The parts of a name at which it may go on in the next line: turnAfterWall, wall_lost. */
export function humpsOf(name: string): string[] {
  return name.split(/(?<=[\p{Ll}\p{Nd}])(?=\p{Lu})|(?<=_)(?=[^_])/u);
}
