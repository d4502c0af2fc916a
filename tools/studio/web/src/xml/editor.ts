// An editor for XML: colours, completion, and marks at mistakes. This file is loaded when an editor is first shown.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, snippet, startCompletion, type Completion, type CompletionContext, type CompletionResult } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { autoCloseTags, xmlLanguage } from '@codemirror/lang-xml';
import { bracketMatching, foldGutter, foldKeymap, HighlightStyle, indentUnit, LanguageSupport, syntaxHighlighting } from '@codemirror/language';
import { lintGutter, lintKeymap, nextDiagnostic, setDiagnostics } from '@codemirror/lint';
import { search, searchKeymap } from '@codemirror/search';
import { Annotation, EditorState, Prec, Transaction, type Extension } from '@codemirror/state';
import { drawSelection, EditorView, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { overClosingTags } from './closing';
import { marksOf, unitsBefore } from './marks';
import type { Problem } from '../protocol/messages';
import type { Suggestion, Suggestions } from './suggest';

interface EditorOptions {
  text: string;
  label: string;
  /** The id of an element that says how to leave the editor. */
  description: string;
  /** Whether it has line numbers, a search and folds. */
  whole: boolean;
  suggestions(before: string, after: string): Promise<Suggestions | null>;
  changed(text: string): void;
  apply?(): void;
}

// Texts that come from outside are not reported as changes of the user.
const outside = Annotation.define<boolean>();

const colours = HighlightStyle.define([
  { tag: tags.tagName, color: 'var(--accent)' },
  { tag: tags.attributeName, color: 'var(--inhibit)' },
  { tag: tags.attributeValue, color: 'var(--warn)' },
  { tag: [tags.comment, tags.processingInstruction, tags.documentMeta], color: 'var(--muted)', fontStyle: 'italic' },
  { tag: [tags.angleBracket, tags.definitionOperator], color: 'var(--muted)' },
]);

// The colours are those of the page, so light and dark need no theme each.
const theme = EditorView.theme({
  '&': { fontSize: '12px', color: 'var(--ink)', backgroundColor: 'var(--raised)' },
  '&.cm-focused': { outline: '2px solid var(--accent)', outlineOffset: '-2px' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '1.45' },
  '.cm-content': { caretColor: 'var(--ink)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': { backgroundColor: 'color-mix(in srgb, var(--accent) 28%, transparent)' },
  '&.cm-focused .cm-matchingBracket': { backgroundColor: 'var(--accent-soft)' },
  '.cm-gutters': { backgroundColor: 'var(--panel)', color: 'var(--muted)', borderRight: '1px solid var(--line)' },
  '.cm-foldPlaceholder': { backgroundColor: 'var(--hover)', border: '0', color: 'var(--muted)' },
  '.cm-tooltip': { backgroundColor: 'var(--panel)', color: 'var(--ink)', border: '1px solid var(--line)', borderRadius: '6px', boxShadow: 'var(--shadow)' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul': { fontFamily: 'var(--mono)', maxHeight: '16em' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--accent-ink)' },
  '.cm-completionDetail': { color: 'var(--muted)', fontStyle: 'normal' },
  'li[aria-selected] .cm-completionDetail': { color: 'inherit' },
  '.cm-completionMatchedText': { textDecoration: 'none', fontWeight: '700' },
  '.cm-tooltip.cm-completionInfo': { maxWidth: '320px', padding: '6px 8px', whiteSpace: 'pre-wrap' },
  '.cm-diagnostic': { padding: '4px 8px', whiteSpace: 'pre-wrap' },
  '.cm-diagnostic-error': { borderLeftColor: 'var(--bad)' },
  '.cm-diagnostic-warning': { borderLeftColor: 'var(--warn)' },
  '.cm-lintRange-error': { backgroundImage: 'none', textDecoration: 'underline wavy var(--bad)', textUnderlineOffset: '3px' },
  '.cm-lintRange-warning': { backgroundImage: 'none', textDecoration: 'underline wavy var(--warn)', textUnderlineOffset: '3px' },
  '.cm-panels': { backgroundColor: 'var(--panel)', color: 'var(--ink)' },
  '.cm-panel.cm-search': { display: 'flex', flexWrap: 'wrap', gap: '4px', alignItems: 'center', padding: '6px 26px 6px 8px', fontSize: '12px' },
  '.cm-panel.cm-search :is(input, button, label)': { fontSize: '12px', margin: '0' },
  '.cm-button': { backgroundImage: 'none', backgroundColor: 'var(--raised)', border: '1px solid var(--line)', borderRadius: '6px', color: 'var(--ink)' },
  '.cm-textfield': { backgroundColor: 'var(--raised)', border: '1px solid var(--line)', color: 'var(--ink)' },
  '.cm-panel.cm-panel-lint ul [aria-selected]': { backgroundColor: 'var(--accent-soft)', color: 'var(--ink)' },
  '.cm-searchMatch': { backgroundColor: 'color-mix(in srgb, var(--warn) 30%, transparent)' },
});

function complete(s: Suggestion, kind: Suggestions['kind']): Completion {
  const template = s.template ?? s.text;
  return {
    label: s.words ? `${s.text} ${s.words}` : s.text,
    displayLabel: s.text,
    detail: s.detail,
    info: s.doc || undefined,
    boost: s.first ? 1 : 0,
    apply(view, completion, from, to) {
      // Braces in a value are no fields.
      if (!template.includes('#{')) view.dispatch({ changes: { from, to, insert: template }, selection: { anchor: from + template.length }, userEvent: 'input.complete' });
      else snippet(template)(view, completion, from, to);
      if (kind === 'attribute' || (kind === 'element' && template.includes('#{'))) startCompletion(view);
    },
  };
}

function source(options: EditorOptions) {
  return async (context: CompletionContext): Promise<CompletionResult | null> => {
    const text = context.state.sliceDoc(0, context.pos);
    const found = await options.suggestions(text, context.state.sliceDoc(context.pos));
    if (!found || !found.all.length) return null;
    // Texts between the tags are no names.
    if (!context.explicit && found.kind === 'element' && text[found.from - 1] !== '<') return null;
    return { from: found.from, options: found.all.map((s) => complete(s, found.kind)), validFor: found.kind === 'value' ? /^[^"'<]*$/ : /^[\w:.-]*$/ };
  };
}

/** The indentation that the text has. */
const unit = (text: string) => /\n(\t|  +)</.exec(text)?.[1]?.slice(0, 8) ?? '  ';

export function makeEditor(parent: HTMLElement, options: EditorOptions) {
  const whole: Extension = options.whole ? [lineNumbers(), foldGutter(), lintGutter(), search({ top: true }), keymap.of([...searchKeymap, ...foldKeymap])] : [];
  const own: Extension = options.apply ? Prec.highest(keymap.of([{ key: 'Mod-Enter', run: () => (options.apply!(), true) }])) : [];
  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: options.text,
      extensions: [
        own,
        whole,
        history(),
        drawSelection(),
        bracketMatching(),
        closeBrackets(),
        new LanguageSupport(xmlLanguage),
        overClosingTags,
        autoCloseTags,
        indentUnit.of(unit(options.text)),
        syntaxHighlighting(colours),
        autocompletion({ override: [source(options)], icons: false }),
        keymap.of([...closeBracketsKeymap, ...completionKeymap, ...lintKeymap, ...historyKeymap, ...defaultKeymap, indentWithTab]),
        theme,
        EditorView.theme({ '&': options.whole ? { height: '100%' } : { maxHeight: '420px' } }),
        EditorView.contentAttributes.of({ 'aria-label': options.label, 'aria-describedby': options.description, spellcheck: 'false', tabindex: '0' }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged && !update.transactions.some((t) => t.annotation(outside))) options.changed(update.state.doc.toString());
        }),
      ],
    }),
  });
  // With the focus, the browser moves its selection to the beginning of what is drawn. The editor does not always see that at once, and then follows it there.
  function focus() {
    view.focus();
    const { anchor, head } = view.state.selection.main;
    const from = view.domAtPos(anchor), to = view.domAtPos(head);
    getSelection()?.setBaseAndExtent(from.node, from.offset, to.node, to.offset);
  }
  return {
    /** Replaces what differs, without a step of undo. Returns whether anything does. */
    setText(now: string): boolean {
      const was = view.state.doc.toString();
      const wanted = now.replace(/\r\n?/g, '\n');
      if (was === wanted) return false;
      let from = 0;
      while (from < Math.min(was.length, wanted.length) && was[from] === wanted[from]) from += 1;
      let end = 0;
      while (end < Math.min(was.length, wanted.length) - from && was[was.length - 1 - end] === wanted[wanted.length - 1 - end]) end += 1;
      view.dispatch({ changes: { from, to: was.length - end, insert: wanted.slice(from, wanted.length - end) }, annotations: [outside.of(true), Transaction.addToHistory.of(false)] });
      return true;
    },
    setProblems: (problems: Problem[]) => view.dispatch(setDiagnostics(view.state, marksOf(view.state.doc, problems))),
    goTo(line: number, column: number) {
      const at = view.state.doc.line(Math.max(1, Math.min(line, view.state.doc.lines)));
      const anchor = at.from + unitsBefore(at.text, column);
      view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: 'center' }) });
      focus();
    },
    next: () => void (nextDiagnostic(view), focus()),
    destroy: () => view.destroy(),
  };
}
