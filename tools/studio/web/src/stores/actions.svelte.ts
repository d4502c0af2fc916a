// What was done, with the shell command and the Python that do the same; and messages for the user.
import type { ActionMessage } from '../protocol/messages';

type Notice = { key: number; kind: 'error' | 'info'; text: string };

class Actions {
  log = $state.raw<(ActionMessage & { at: Date })[]>([]);
  notices = $state.raw<Notice[]>([]);
  private begun = $state.raw(new Date());
  private nextKey = 1;

  add(action: ActionMessage): void {
    this.log = [...this.log.slice(-499), { ...action, at: new Date() }];
  }
  /** Marks that another system is open: earlier actions are not about it. */
  beginSystem(): void {
    this.begun = new Date();
  }
  /** The last action on the system that is open. */
  get last(): ActionMessage | undefined {
    const action = this.log[this.log.length - 1];
    return action && action.at >= this.begun ? action : undefined;
  }
  /** Shows a message; an error stays until it is closed. */
  notify(kind: Notice['kind'], text: string): void {
    if (this.notices.some((n) => n.text === text)) return;
    const notice = { key: this.nextKey++, kind, text };
    this.notices = [...this.notices.slice(-2), notice];
    if (kind === 'info') setTimeout(() => this.dismiss(notice.key), Math.max(4000, 80 * text.length)); // time to read it
  }
  dismiss(key: number): void {
    this.notices = this.notices.filter((n) => n.key !== key);
  }
}

export const actions = new Actions();
