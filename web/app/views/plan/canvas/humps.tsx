import { Fragment } from 'react';
import { humpsOf } from '../../../../core/plan/humps';

/** A name that may go on in the next line where a part of it begins. */
export function Humps({ name }: { name: string }) {
  return humpsOf(name).map((part, at) => (
    <Fragment key={`${at} ${part}`}>
      {at > 0 ? <wbr /> : null}
      {part}
    </Fragment>
  ));
}
