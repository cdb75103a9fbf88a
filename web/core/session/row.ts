// Which steps are one step of undo. Without the editor: what is shown first needs this, and not that.

/** Steps at one place that follow each other within this time are one. */
export const kRowMs = 1000;

/** What a change is one of: the keys that move one thing. */
export interface Row {
  of: string;
  at: number;
}
