import type { Operation } from '../../protocol/commands';
import type { EditItem } from '../../protocol/messages';

/** Changes a part of the item that a form shows, and sends the operations for it. */
export type Change = (part: Partial<EditItem>, operation: Operation | Operation[], merge: string) => Promise<unknown>;
