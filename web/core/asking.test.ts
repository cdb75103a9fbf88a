import { expect, test } from 'vitest';
import { Asking, type WhyLink } from './asking';

const link = (what: string): WhyLink => ({ t: 1, what, value: '', place: '', root: true });

test('the answer to a question before the last one counts no more', async () => {
  const answers: ((chain: WhyLink[]) => void)[] = [];
  const asking = new Asking(
    () => new Promise((resolve) => answers.push((chain) => resolve({ chain }))),
  );
  const first = asking.ask({ about: 'motor', name: 'carbot', t: null });
  const second = asking.ask({ about: 'end', name: '', t: null });
  answers[1]?.([link('second')]);
  answers[0]?.([link('first')]);
  await Promise.all([first, second]);
  expect(asking.chain?.map(({ what }) => what)).toEqual(['second']);
  expect(asking.waits).toBe(false);
});

test('a question that is forgotten is not answered any more', async () => {
  let answer: (chain: WhyLink[]) => void = () => {};
  const asking = new Asking(
    () => new Promise((resolve) => (answer = (chain) => resolve({ chain }))),
  );
  const asked = asking.ask({ about: 'end', name: '', t: null });
  asking.forget();
  answer([link('of a run that is gone')]);
  await asked;
  expect(asking.question).toBeNull();
  expect(asking.chain).toBeNull();
});

test('what cannot be answered says why, and the name and the instant are left out where there are none', async () => {
  const inputs: unknown[] = [];
  const asking = new Asking((input) => {
    inputs.push(input);
    return Promise.reject(new Error('nothing has run yet'));
  });
  await asking.ask({ about: 'end', name: '', t: null });
  await asking.ask({ about: 'actor', name: 'follow', t: 2.5 });
  await asking.ask({ about: 'event', name: 'seen', t: 2.5, robot: 'r4' });
  expect(inputs).toEqual([
    { about: 'end' },
    { about: 'actor', name: 'follow', t: 2.5 },
    { about: 'event', name: 'seen', t: 2.5, robot: 'r4' },
  ]);
  expect(asking.chain).toBeNull();
  expect(asking.trouble).toBe('nothing has run yet');
  expect(asking.waits).toBe(false);
});
