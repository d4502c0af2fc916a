// Closing tags that are typed although they stand in the text already: what is typed goes over them and is not doubled.
import { Prec, StateEffect, StateField, type Extension } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { scan } from './scan';

/** The closing tag that follows a place, but for spaces, if it ends the element that is open there: where it begins and ends after the place. */
export function closingAhead(before: string, after: string): { from: number; to: number; name: string } | null {
  const found = /^(\s*)<\/([\w:.-]+)>/.exec(after);
  const place = found && scan(before).place;
  if (!found || place?.kind !== 'content' || place.parent?.name !== found[2]) return null;
  return { from: found[1]!.length, to: found[0].length, name: found[2]! };
}

/** What is left of a closing tag that the editor wrote and the user types again. The cursor stands at its end. */
const setRest = StateEffect.define<string>();
const rest = StateField.define<string>({
  create: () => '',
  update(value, transaction) {
    for (const e of transaction.effects) if (e.is(setRest)) return e.value;
    if (!transaction.docChanged) return transaction.selection ? '' : value;
    if (!transaction.isUserEvent('input.complete')) return '';
    // The editor wrote the name after '</'.
    let ended = '';
    transaction.changes.iterChanges((_a, _b, from, to, text) => {
      if (transaction.newDoc.sliceString(from - 2, from) === '</' && transaction.newSelection.main.head === to) ended = text.toString();
    });
    return /^[\w:.-]+>$/.test(ended) ? ended : '';
  },
});

const typedOver = EditorView.inputHandler.of((view, from, to, text) => {
  if (from !== to || view.composing) return false;
  const { state } = view;
  const left = state.field(rest);
  if (left && left.startsWith(text)) {
    view.dispatch({ effects: setRest.of(left.slice(text.length)) });
    return true;
  }
  if (text !== '/' || state.sliceDoc(from - 1, from) !== '<') return false;
  const ahead = closingAhead(state.sliceDoc(0, from - 1), state.sliceDoc(from));
  if (!ahead) return false;
  // The tag that is there comes to the place of the one that is typed.
  const anchor = from - 1 + ahead.to - ahead.from;
  view.dispatch({ changes: { from: from - 1, to: from + ahead.from }, selection: { anchor }, effects: setRest.of(`${ahead.name}>`), userEvent: 'input.type', scrollIntoView: true });
  return true;
});

/** To be used with autoCloseTags, which writes the tags. */
export const overClosingTags: Extension = [rest, Prec.high(typedOver)];
