// Where the mistakes of a text are, as places of the editor.
import type { Text } from '@codemirror/state';
import type { Problem } from '../protocol/messages';

type Mark = { from: number; to: number; severity: 'error' | 'warning'; message: string };

/** The units of a JavaScript text before a column that counts bytes from 1. */
export const unitsBefore = (line: string, column: number): number => new TextDecoder('utf-8', { ignoreBOM: true }).decode(new TextEncoder().encode(line).subarray(0, column - 1)).length;

/** The part of a line that a mistake at `at` is about: a name, a value in quotes, or a character. */
export function extent(line: string, at: number): [number, number] {
  const rest = line.slice(at);
  const found = /^(<\/?[\w:.-]*|"[^"]*"?|'[^']*'?|[\w:.-]+|\S)/.exec(rest);
  if (found) return [at, at + found[0].length];
  // At the end of a line, or before blanks: what stands before it.
  const before = /\S+\s*$/.exec(line.slice(0, at));
  return before ? [before.index, before.index + before[0].trimEnd().length] : [0, line.length];
}

/** The problems with a line, as places of the text. */
export function marksOf(text: Text, problems: Problem[]): Mark[] {
  return problems
    .filter((p) => p.line)
    .map((p) => {
      const line = text.line(Math.min(p.line!, text.lines)), [from, to] = extent(line.text, unitsBefore(line.text, p.column ?? 1));
      return { from: line.from + from, to: line.from + to, severity: p.severity === 'warning' ? ('warning' as const) : ('error' as const), message: p.hint ? `${p.message}\n${p.hint}` : p.message };
    })
    .sort((a, b) => a.from - b.from);
}
