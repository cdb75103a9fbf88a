import { expect, test } from 'vitest';
import { ChangeQuestion, type ChangeAnswer } from './change';

function questions() {
  const asked: ((answer: ChangeAnswer) => void)[] = [];
  const timers: (() => void)[] = [];
  const question = new ChangeQuestion(
    () => new Promise((done) => asked.push(done)),
    (_, act) => (timers.push(act), () => void timers.splice(timers.indexOf(act), 1)),
  );
  return { question, asked, timers };
}

const good: ChangeAnswer = { runs: true, reasons: [] };
const settled = () => new Promise((done) => setTimeout(done));

test('what changes while an answer is awaited is asked once more, and no oftener', async () => {
  const { question, asked, timers } = questions();
  question.look();
  question.look();
  question.look();
  expect(asked.length).toBe(1);
  asked[0]?.(good);
  await settled();
  expect(question.answer).toBe(good);
  expect(asked.length).toBe(1);
  timers.shift()?.();
  expect(asked.length).toBe(2);
  asked[1]?.(good);
  await settled();
  timers.shift()?.();
  expect(asked.length).toBe(2);
});

test('an answer that comes after the end is nobody’s', async () => {
  const { question, asked, timers } = questions();
  question.look();
  question.end();
  asked[0]?.(good);
  await settled();
  expect(question.answer).toBeNull();
  question.look();
  expect([asked.length, timers.length]).toEqual([1, 0]);
});
