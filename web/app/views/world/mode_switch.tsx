import { text } from '../../text';

export const worldModes = ['live', 'edit', 'text'] as const;
export type WorldMode = (typeof worldModes)[number];

/** The same world three times: as it runs, its file drawn, its file as text. */
export function ModeSwitch(props: { mode: WorldMode; onChange: (mode: WorldMode) => void }) {
  const { mode, onChange } = props;
  const step = (by: number) => {
    const at = worldModes.indexOf(mode) + by + worldModes.length;
    onChange(worldModes[at % worldModes.length] ?? 'live');
  };
  return (
    <div
      className="seg seg--small"
      role="radiogroup"
      aria-label={text.world.mode}
      onKeyDown={(event) => {
        const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        step(by);
        const group = event.currentTarget;
        requestAnimationFrame(() =>
          group.querySelector<HTMLElement>('[aria-checked="true"]')?.focus(),
        );
      }}
    >
      {worldModes.map((one) => (
        <button
          key={one}
          type="button"
          role="radio"
          className="seg__part"
          aria-checked={one === mode}
          tabIndex={one === mode ? 0 : -1}
          onClick={() => onChange(one)}
        >
          {text.world.modes[one]}
        </button>
      ))}
    </div>
  );
}
