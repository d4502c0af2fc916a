import { request } from '../studio';
import type { Vocabulary } from '../protocol/messages';

let asked: Promise<Vocabulary | null> | null = null;
/** The vocabulary of the server, which is asked for it once; null when it does not answer. */
export function vocabulary(): Promise<Vocabulary | null> {
  asked ??= request('vocabulary').catch(() => (asked = null));
  return asked;
}
