// Words of the answer to a question about a run: apart from text.ts, as they come with its panel.

import type { Question } from '../../../core/asking';

export const whyWords = {
  views: 'Question',
  why: 'Why?',
  decided: 'When was it decided?',
  nothing: 'Nothing has been asked yet.',
  how: 'Ask about a robot in the world, an actor of the plan, a variable or an event: choose it and press W, or choose “Why?” in its menu.',
  waits: 'The run is run again…',
  chain: 'What it followed from, the newest first',
  copy: 'Copy as text',
  copied: 'The answer',
  again: 'Ask again',
  at: (t: string) => `at ${t} s`,
  now: 'now',
  root: 'Here it began.',
  later: (ms: string) => `${ms} later`,
};

const questions: Record<Question['about'], (name: string) => string> = {
  actor: (name) => `Why is ${name} active, or why did it end?`,
  variable: (name) => `Why has ${name} its value?`,
  motor: (name) => `Why do the wheels of ${name} turn as they do?`,
  event: (name) => `Why was ${name} emitted?`,
  end: () => 'Why did the run end?',
};

export const questionOf = ({ about, name }: Question): string => questions[about](name);
