// The state of the run, and what the connection costs.
import type { Link } from '../connection';
import type { HelloMessage, StatusMessage } from '../protocol/messages';

class RunState {
  link = $state<Link>('connecting');
  hello = $state.raw<HelloMessage | null>(null);
  /** Whether a page has ended the program. */
  ended = $state(false);
  refused = $state<string | null>(null);
  status = $state.raw<StatusMessage | null>(null);
  framesPerSecond = $state(0);
  /** Frames that the server sent and this page superseded before drawing. */
  superseded = $state(0);
  /** Cycles between the run and what the page shows. */
  lag = $state(0);

  /** Whether the server can do what another may not. */
  can(capability: HelloMessage['capabilities'][number]): boolean {
    return this.hello?.capabilities.includes(capability) ?? false;
  }
}

export const run = new RunState();
