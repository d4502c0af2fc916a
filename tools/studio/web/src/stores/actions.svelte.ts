// What was done, with the shell command and the Python that do the same; and messages for the user.
import type { Done } from '../draw/trials';
import type { ActionMessage } from '../protocol/messages';

interface Notice {
  key: number;
  kind: 'error' | 'info';
  text: string;
  /** The message goes when this is settled. */
  cause?: string;
  /** A button in the message. */
  action?: { label: string; act(): unknown };
}

class Actions {
  log = $state.raw<Done[]>([]);
  notices = $state.raw<Notice[]>([]);
  private nextKey = 1;

  add(action: ActionMessage, epoch: number | undefined): void {
    this.log = [...this.log.slice(-499), { ...action, epoch }];
  }
  /** Shows a message; an error stays until it is closed, or its cause is settled. */
  notify(kind: Notice['kind'], text: string, { cause, action }: Pick<Notice, 'cause' | 'action'> = {}): void {
    if (this.notices.some((n) => n.text === text)) return;
    const notice = { key: this.nextKey++, kind, text, cause, action };
    this.notices = [...this.notices.slice(-2), notice];
    if (kind === 'info') setTimeout(() => this.dismiss(notice.key), Math.max(action ? 10000 : 4000, 80 * text.length)); // time to read it
  }
  /** Takes away the messages of a cause; without one, all errors. */
  settle(cause?: string): void {
    if (this.notices.some((n) => (cause === undefined ? n.kind === 'error' : n.cause === cause))) this.notices = this.notices.filter((n) => (cause === undefined ? n.kind !== 'error' : n.cause !== cause));
  }
  dismiss(key: number): void {
    this.notices = this.notices.filter((n) => n.key !== key);
  }
}

export const actions = new Actions();
