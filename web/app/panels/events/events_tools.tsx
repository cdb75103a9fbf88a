import { IconSend2 } from '@tabler/icons-react';
import { updateEvents } from '../../../core/window_state';
import { useStudio, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { eventWords } from './words';

/** At the head of the panel: opens and closes the form that sends an event. */
export default function EventsTools() {
  const { window: store } = useStudio();
  const open = useWindow((state) => state.events.send);
  return (
    <Button
      kind="plain"
      small
      aria-expanded={open}
      className={open ? 'is-on' : ''}
      icon={<IconSend2 size={14} stroke={kStroke} />}
      onClick={() => updateEvents(store, { send: !open })}
    >
      {eventWords.sendMore}
    </Button>
  );
}
