import { request } from '../studio';
import type { Vocabulary } from '../protocol/messages';

let loading: Promise<Vocabulary | null> | null = null;
/** Loads the vocabulary from the server, once; null when the server does not reply. */
export function loadVocabulary(): Promise<Vocabulary | null> {
  loading ??= request('vocabulary').catch(() => (loading = null));
  return loading;
}
