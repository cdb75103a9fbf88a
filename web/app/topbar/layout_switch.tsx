import { useRef } from 'react';
import { layoutNames, type LayoutName } from '../../core/layouts';
import { chooseLayout } from '../commands/view_commands';
import { useStudio, useWindow } from '../hooks';
import { text } from '../text';

/** Draw, Script, Debug, Present: arrows choose, as in any group of radio buttons. */
export function LayoutSwitch() {
  const studio = useStudio();
  const chosen = useWindow((state) => state.layout);
  const group = useRef<HTMLDivElement>(null);
  const choose = (layout: LayoutName) => chooseLayout(studio, layout);
  const move = (by: number) => {
    const next = (layoutNames.indexOf(chosen) + by + layoutNames.length) % layoutNames.length;
    choose(layoutNames[next] ?? 'Script');
    group.current?.querySelectorAll('button')[next]?.focus();
  };
  return (
    <div className="seg" role="radiogroup" aria-label={text.layout} ref={group}>
      {layoutNames.map((layout) => (
        <button
          key={layout}
          type="button"
          role="radio"
          className="seg__part"
          aria-checked={layout === chosen}
          tabIndex={layout === chosen ? 0 : -1}
          onClick={() => choose(layout)}
          onKeyDown={(event) => {
            const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
            if (by) (event.preventDefault(), move(by));
          }}
        >
          {text.layouts[layout]}
        </button>
      ))}
    </div>
  );
}
