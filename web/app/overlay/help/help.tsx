import { IconX } from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import { useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { KeysList } from '../../parts/keys_list';
import { OverlayFrame, useCloseOverlay } from '../../parts/overlay_frame';
import { text } from '../../text';
import { HelpSearch } from './help_search';
import { helpWords } from './words';
import '../../look/help.css';

const words = helpWords;
const tabs = ['help', 'keys'] as const;

/** The language, the robot and the keys, over the window. */
export default function Help() {
  const { tab, query } = useWindow((state) => state.help);
  // Asked for once more, at another word or for the keys: it begins there.
  return <HelpAt key={`${tab} ${query}`} first={tab} query={query} />;
}

function HelpAt({ first, query }: { first: (typeof tabs)[number]; query: string }) {
  const close = useCloseOverlay();
  const [tab, setTab] = useState(first);
  const onKeyDown = (event: KeyboardEvent<HTMLElement>) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    const other = tab === 'help' ? 'keys' : 'help';
    setTab(other);
    event.currentTarget.querySelector<HTMLElement>(`[data-tab="${other}"]`)?.focus();
    event.preventDefault();
  };
  return (
    <OverlayFrame label={words.tabs[tab]}>
      <div className="sheet help">
        <div className="sheet__head">
          <div className="help__tabs" role="tablist" aria-label={words.title} onKeyDown={onKeyDown}>
            {tabs.map((one) => (
              <button
                key={one}
                type="button"
                role="tab"
                data-tab={one}
                className={one === tab ? 'help__tab is-on' : 'help__tab'}
                aria-selected={one === tab}
                aria-controls="help-view"
                tabIndex={one === tab ? 0 : -1}
                onClick={() => setTab(one)}
              >
                {words.tabs[one]}
              </button>
            ))}
          </div>
          <Button
            autoFocus={first === 'keys'}
            kind="plain"
            tip={text.overlay.close}
            icon={<IconX size={16} stroke={kStroke} />}
            onClick={close}
          />
        </div>
        <div className="help__view" role="tabpanel" id="help-view" aria-label={words.tabs[tab]}>
          {tab === 'help' ? (
            <HelpSearch first={query} takesFocus={first === 'help'} />
          ) : (
            <div className="help__keys" tabIndex={0} role="group" aria-label={words.tabs.keys}>
              <KeysList />
            </div>
          )}
        </div>
      </div>
    </OverlayFrame>
  );
}
