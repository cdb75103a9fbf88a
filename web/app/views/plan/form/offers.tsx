import { Popover } from '@mantine/core';
import { useEffect, useRef, type ReactElement } from 'react';
import type { Offer } from '../../../../core/plan/completion';
import { drawWords } from '../words';

/** What may be written at the caret, below the field that is typed into. */
export function Offers(props: {
  id: string;
  field: ReactElement;
  offers: readonly Offer[];
  chosen: number;
  onTake: (offer: Offer) => void;
}) {
  const { id, field, offers, chosen, onTake } = props;
  return (
    <Popover
      opened={offers.length > 0}
      position="bottom-start"
      offset={2}
      transitionProps={{ duration: 0 }}
      classNames={{ dropdown: 'menu offers' }}
      withRoles={false}
    >
      <Popover.Target>{field}</Popover.Target>
      <Popover.Dropdown>
        <ul id={id} role="listbox" aria-label={drawWords.offers}>
          {offers.map((offer, index) => (
            <Item
              key={`${offer.is} ${offer.name}`}
              id={offerId(id, index)}
              offer={offer}
              isChosen={index === chosen}
              onTake={() => onTake(offer)}
            />
          ))}
        </ul>
        {offers[chosen]?.help ? <p className="offers__help">{offers[chosen].help}</p> : null}
      </Popover.Dropdown>
    </Popover>
  );
}

export const offerId = (list: string, index: number) => `${list}-${index}`;

function Item(props: { id: string; offer: Offer; isChosen: boolean; onTake: () => void }) {
  const { id, offer, isChosen, onTake } = props;
  const row = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (isChosen) row.current?.scrollIntoView({ block: 'nearest' });
  }, [isChosen]);
  return (
    <li
      ref={row}
      id={id}
      role="option"
      className="offer"
      aria-selected={isChosen}
      title={offer.help}
      // The field keeps the focus.
      onMouseDown={(event) => event.preventDefault()}
      onClick={onTake}
    >
      <code>{offer.name}</code>
      <span className="muted ellipsis">{offer.detail}</span>
    </li>
  );
}
