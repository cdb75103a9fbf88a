import type { KeyboardEvent } from 'react';
import { phoneWords } from './words';

export const phoneTabs = ['plan', 'world', 'variables', 'console'] as const;
export type PhoneTab = (typeof phoneTabs)[number];

/** One view at a time fits; the tabs choose it. */
export function PhoneTabs(props: { chosen: PhoneTab; onChoose: (tab: PhoneTab) => void }) {
  const { chosen, onChoose } = props;
  const onKeyDown = (event: KeyboardEvent<HTMLElement>) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (step === 0) return;
    const at = (phoneTabs.indexOf(chosen) + step + phoneTabs.length) % phoneTabs.length;
    const next = phoneTabs[at] ?? chosen;
    onChoose(next);
    event.currentTarget.querySelector<HTMLElement>(`[data-tab="${next}"]`)?.focus();
    event.preventDefault();
  };
  return (
    <div className="phone__tabs" role="tablist" aria-label={phoneWords.views} onKeyDown={onKeyDown}>
      {phoneTabs.map((tab) => (
        <button
          key={tab}
          type="button"
          role="tab"
          data-tab={tab}
          data-inset
          className={tab === chosen ? 'phone__tab is-on' : 'phone__tab'}
          aria-selected={tab === chosen}
          aria-controls="phone-view"
          tabIndex={tab === chosen ? 0 : -1}
          onClick={() => onChoose(tab)}
        >
          {phoneWords.tabs[tab]}
        </button>
      ))}
    </div>
  );
}
