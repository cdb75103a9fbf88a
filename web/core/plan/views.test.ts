import { expect, it } from 'vitest';
import { kViewsMax, Views } from './views';

const view = { x: -40, y: 12.5, zoom: 0.8 };

it('knows what was kept, also from its text', () => {
  const views = new Views(null);
  views.keep('P.plan.json', { x: 0, y: 0, zoom: 1 });
  views.keep('P.plan.json', view);
  expect(new Views(views.text()).get('P.plan.json')).toEqual(view);
  expect(views.get('Q.plan.json')).toBe(undefined);
});

it('takes nothing from a text that is not its own', () => {
  for (const text of [
    '',
    '{',
    '{}',
    '[1]',
    '[["P", {"x": 1, "y": 2}]]',
    '[["P", {"x": 1, "y": 2, "zoom": 0}]]',
  ])
    expect(new Views(text).get('P'), text).toBe(undefined);
});

it('forgets the one that was kept longest ago when there are too many', () => {
  const views = new Views(null);
  for (let at = 0; at < kViewsMax; at++) views.keep(`${at}`, view);
  views.keep('0', view);
  views.keep('one more', view);
  expect(views.get('0')).toEqual(view);
  expect(views.get('1')).toBe(undefined);
  expect(views.get('2')).toEqual(view);
});
