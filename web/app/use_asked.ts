import { useEffect, useState } from 'react';
import type { Commands } from '../protocol/messages';
import { useStudio } from './hooks';

/**
 * What the server answers to a command that only looks; null until it has. It is asked again when
 * `again` is another value. A refusal is told to the person, and is 'refused' here.
 */
export function useAsked<C extends keyof Commands>(
  command: C,
  input: Commands[C]['in'],
  again?: unknown,
): Commands[C]['out'] | 'refused' | null {
  const studio = useStudio();
  const [answer, setAnswer] = useState<Commands[C]['out'] | 'refused' | null>(null);
  const key = JSON.stringify(input);
  useEffect(() => {
    let gone = false;
    studio.send(command, JSON.parse(key) as Commands[C]['in']).then(
      (came) => gone || setAnswer(came),
      (problem: unknown) => gone || (setAnswer('refused'), studio.tell(problem)),
    );
    return () => void (gone = true);
  }, [studio, command, key, again]);
  return answer;
}
