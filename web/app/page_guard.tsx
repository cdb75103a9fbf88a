import { Component, type ReactNode } from 'react';
import type { Studio } from '../core/studio';
import { text } from './text';

const words = text.page;

/** Around everything: a fault of the page itself is told, and the robot can still be stopped. */
export class PageGuard extends Component<
  { studio: Studio; children: ReactNode },
  { failed: string | null }
> {
  override state = { failed: null };

  static getDerivedStateFromError(problem: unknown) {
    return { failed: problem instanceof Error ? problem.message : String(problem) };
  }

  override render() {
    const { failed } = this.state;
    if (failed === null) return this.props.children;
    return (
      <main className="pageguard" role="alert">
        <h1>{words.failed}</h1>
        <p>{words.help}</p>
        <pre>{failed}</pre>
        <button
          type="button"
          className="btn is-stop"
          onClick={() => void this.props.studio.stopping.press()}
        >
          {text.commands['run.stop']}
        </button>
        <button
          type="button"
          className="btn btn--primary"
          autoFocus
          onClick={() => location.reload()}
        >
          {text.late.reload}
        </button>
      </main>
    );
  }
}
