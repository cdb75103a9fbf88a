import { describe, expect, it } from 'vitest';
import type { Line } from '../../protocol/messages';
import type { Arrow } from './arrows';
import { ledHere } from './led_here';

const arrow = (id: string, source: string, outcome: string, target: string) =>
  ({ id, source, outcome, target }) as Arrow;
const drawing = {
  arrows: [
    arrow('start', '@start', '', 'go'),
    arrow('done', 'go', 'Done', 'turn'),
    arrow('touch', 'go/bumper', 'Touched', 'turn'),
    arrow('again', 'turn', 'Done', 'go'),
  ],
};
const line = (t: number, text: string): Line => ({ number: 0, t, kind: 'note', text });
const level = (actor: string, since: number, activation: number) => ({ actor, since, activation });

describe('the arrow that led to an actor', () => {
  it('is that of the state or event that is told last', () => {
    const story = [
      line(1, 'go: Done → turn'),
      line(2, 'turn: Done → go'),
      line(3, 'bumper: Touched → turn'),
    ];
    expect(ledHere({ story }, level('turn', 3, 4), drawing)).toBe('touch');
    expect(ledHere({ story: story.slice(0, 1) }, level('turn', 1, 2), drawing)).toBe('done');
    // Of what is told, only what was before the actor began.
    expect(ledHere({ story }, level('turn', 1, 2), drawing)).toBe('done');
  });

  it('is that of the start, for the first one', () => {
    expect(ledHere({ story: [] }, level('go', 0, 1), drawing)).toBe('start');
    expect(ledHere({ story: [] }, level('go', 7, 3), drawing)).toBeNull();
    expect(ledHere({ story: [] }, level('', 0, 0), drawing)).toBeNull();
  });
});
