// The changes that lead from one text to another: what is common at both ends stays, and where the
// number of lines between is the same, each line is looked at by itself. So a rename in ten places
// is ten small changes, and a caret between them stays where it is.

export interface Replaced {
  from: number;
  to: number;
  insert: string;
}

export function textDiff(before: string, after: string): Replaced[] {
  const whole = trimmed(before, after, 0);
  if (!whole) return [];
  const oldLines = before.slice(whole.from, whole.to).split('\n');
  const newLines = whole.insert.split('\n');
  if (oldLines.length !== newLines.length || oldLines.length < 2) return [whole];
  const changes: Replaced[] = [];
  let at = whole.from;
  oldLines.forEach((line, index) => {
    const change = trimmed(line, newLines[index] ?? '', at);
    if (change) changes.push(change);
    at += line.length + 1;
  });
  return changes;
}

function trimmed(before: string, after: string, at: number): Replaced | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let start = 0;
  while (start < shorter && before[start] === after[start]) start++;
  let end = 0;
  while (end < shorter - start && before[before.length - 1 - end] === after[after.length - 1 - end])
    end++;
  return {
    from: at + start,
    to: at + before.length - end,
    insert: after.slice(start, after.length - end),
  };
}
