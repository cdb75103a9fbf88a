import { useState } from 'react';
import { keepToken } from '../../core/identity';
import { useStudio } from '../hooks';
import { Button } from '../parts/button';
import { OverlayFrame, useCloseOverlay } from '../parts/overlay_frame';
import { newTokenWords } from './new_token_words';
import '../look/palette.css';

const words = newTokenWords;

/** Says what a new token means for others, makes it, and shows the address that has it. */
export default function NewToken() {
  const studio = useStudio();
  const close = useCloseOverlay();
  const [address, setAddress] = useState<string | null>(null);
  const make = () =>
    studio.renewToken().then(
      (token) => {
        keepToken(sessionStorage, token);
        setAddress(`${location.origin}${location.pathname}#token=${token}`);
      },
      (problem: unknown) => studio.tell(problem),
    );
  return (
    <OverlayFrame label={words.title}>
      <div className="sheet sheet--small">
        <div className="sheet__head">
          <h2>{words.title}</h2>
        </div>
        <div className="newtemplate">
          <p className="quiet">{address === null ? words.what : words.made}</p>
          {address === null ? null : (
            <label>
              <span>{words.address}</span>
              <input
                className="field field--small"
                readOnly
                autoFocus
                value={address}
                onFocus={({ target }) => target.select()}
              />
            </label>
          )}
          <div className="newtemplate__buttons">
            <Button small kind="plain" autoFocus onClick={close}>
              {address === null ? words.cancel : words.close}
            </Button>
            {address === null ? (
              <Button small onClick={() => void make()}>
                {words.make}
              </Button>
            ) : null}
          </div>
        </div>
      </div>
    </OverlayFrame>
  );
}
