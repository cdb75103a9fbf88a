import { Component, type ReactNode } from 'react';
import type { Studio } from '../core/studio';
import { text } from './text';

const words = text.page;

interface Failed {
  failed: string | null;
  /** What was typed is on its way to the server: then the page is loaded again. */
  leaves: boolean;
}

/** Around everything: a fault of the page itself is told, the robot can still be stopped, and what was typed is sent. */
export class PageGuard extends Component<{ studio: Studio; children: ReactNode }, Failed> {
  override state: Failed = { failed: null, leaves: false };

  static getDerivedStateFromError(problem: unknown) {
    return { failed: problem instanceof Error ? problem.message : String(problem) };
  }

  /** The fields are still there: what is typed in them counts before they go. */
  override getSnapshotBeforeUpdate(_props: unknown, before: Failed): null {
    if (this.state.failed !== null && before.failed === null)
      this.props.studio.documents.fields.settle();
    return null;
  }

  /** The window's own listener went with what was shown. */
  override componentDidUpdate(_props: unknown, before: Failed): void {
    if (this.state.failed !== null && before.failed === null)
      addEventListener('beforeunload', this.leave);
  }

  override componentWillUnmount(): void {
    removeEventListener('beforeunload', this.leave);
  }

  private readonly leave = (event: BeforeUnloadEvent) => {
    if (this.props.studio.documents.isUnsent) event.preventDefault();
  };

  /** What the server refuses is asked about by the browser. */
  private readonly reload = () => {
    this.setState({ leaves: true });
    const load = () => location.reload();
    this.props.studio.documents.flushAll().then(load, load);
  };

  override render() {
    const { failed, leaves } = this.state;
    const { studio, children } = this.props;
    if (failed === null) return children;
    return (
      <main className="pageguard" role="alert">
        <h1>{words.failed}</h1>
        <p>{leaves && studio.documents.isUnsent ? words.sends : words.help}</p>
        <pre>{failed}</pre>
        <button type="button" className="btn is-stop" onClick={() => void studio.stopping.press()}>
          {text.commands['run.stop']}
        </button>
        <button type="button" className="btn btn--primary" autoFocus onClick={this.reload}>
          {text.late.reload}
        </button>
      </main>
    );
  }
}
