// A component that is loaded when it is first shown. If that fails, because the server was started again
// or the connection is cut, it is tried a few times more; then a panel says so and offers to try again.

import { IconPlugConnectedX, IconRefresh } from '@tabler/icons-react';
import { Component, createElement, lazy, type ComponentType, type ReactNode } from 'react';
import { retried } from '../../core/retry';
import { text } from '../text';
import { Blank } from './blank';
import { Button } from './button';
import { kStroke } from './icons';

const words = text.late;

type Load<P> = () => Promise<{ default: ComponentType<P> }>;
/** What is in the place of a component that could not be loaded: where there is little room, a button. */
type Instead = 'panel' | 'button';

class LoadError extends Error {}

export function late<P extends object>(
  load: Load<P>,
  instead: Instead = 'panel',
): ComponentType<P> {
  const make = () =>
    lazy(() =>
      retried(load).catch((problem: unknown) => {
        throw new LoadError(String(problem));
      }),
    );
  // A failed one stays failed: the next try needs one of its own.
  let view: ComponentType<P> = make();
  return function Late(props: P) {
    return (
      <Guard instead={instead} again={() => void (view = make())}>
        {() => createElement(view, props)}
      </Guard>
    );
  };
}

interface GuardProps {
  instead: Instead;
  again(): void;
  children(): ReactNode;
}

/** Other failures than those of loading go on to the part that shows them. */
class Guard extends Component<GuardProps, { failed: Error | null }> {
  override state: { failed: Error | null } = { failed: null };

  static getDerivedStateFromError(failed: Error) {
    return { failed };
  }

  override render() {
    const { failed } = this.state;
    if (failed === null) return <Shown make={this.props.children} />;
    if (!(failed instanceof LoadError)) throw failed;
    const again = () => {
      this.props.again();
      this.setState({ failed: null });
    };
    return this.props.instead === 'panel' ? (
      <Failed again={again} />
    ) : (
      <FailedSmall again={again} />
    );
  }
}

// Below the guard, which catches what is thrown in its children only.
function Shown({ make }: { make(): ReactNode }) {
  return make();
}

function Failed({ again }: { again(): void }) {
  return (
    <Blank
      icon={<IconPlugConnectedX className="icon" size={20} stroke={kStroke} aria-hidden />}
      title={words.failed}
    >
      <p>{words.help}</p>
      <div className="blank__row">
        <Button onClick={again}>{words.again}</Button>
        <Button kind="plain" onClick={() => location.reload()}>
          {words.reload}
        </Button>
      </div>
    </Blank>
  );
}

function FailedSmall({ again }: { again(): void }) {
  return (
    <Button
      kind="plain"
      small
      tip={words.small}
      icon={<IconRefresh size={14} stroke={kStroke} />}
      onClick={again}
    />
  );
}
