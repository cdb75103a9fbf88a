import { useEffect, useRef } from 'react';
import { useStudio, useTopic } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { formWords } from './form_words';

/** In the form of a robot. */
export function PressButtons({ robot }: { robot: string }) {
  return (
    <div className="prop__group">
      <h3 className="prop__title">{formWords.buttons}</h3>
      <ButtonRow robot={robot} />
    </div>
  );
}

/** Buttons and touch sensors of a robot: down as long as they are held, by mouse or by key. */
export function ButtonRow({ robot }: { robot: string }) {
  const studio = useStudio();
  const drives = useMayAct();
  const known = useTopic('scene', {})?.robots.find((one) => one.name === robot);
  if (!known) return null;
  return (
    <div className="prop__buttons">
      {known.buttons.map((button) => (
        <HeldButton key={button} robot={robot} button={button} />
      ))}
      {known.type === 'thymio2' ? (
        <Button
          small
          disabled={!drives}
          tip={formWords.tapHelp}
          onClick={() => studio.order('world.tap', { robot })}
        >
          {formWords.tap}
        </Button>
      ) : null}
    </div>
  );
}

function HeldButton({ robot, button }: { robot: string; button: string }) {
  const studio = useStudio();
  const drives = useMayAct();
  const down = useRef(false);
  const press = (to: boolean) => {
    if (down.current === to) return;
    down.current = to;
    studio.order('world.press', { robot, button, down: to });
  };
  // A form that goes away lets go.
  useEffect(
    () => () => {
      if (down.current) studio.order('world.press', { robot, button, down: false });
    },
    [studio, robot, button],
  );
  return (
    <Button
      small
      disabled={!drives}
      aria-label={formWords.press(button)}
      onPointerDown={() => press(true)}
      onPointerUp={() => press(false)}
      onPointerLeave={() => press(false)}
      onPointerCancel={() => press(false)}
      onKeyDown={(event) => {
        if (event.key === ' ' || event.key === 'Enter') press(true);
      }}
      onKeyUp={() => press(false)}
      onBlur={() => press(false)}
    >
      {button}
    </Button>
  );
}
