/** What a caught problem says. */
export const whyOf = (problem: unknown): string =>
  problem instanceof Error ? problem.message : String(problem);
