// Makes a page of the panel Tutorial from a file of docs/tutorial. Runs in the build; the page of the studio gets the HTML.
import { Marked } from 'marked';
import { formulas, greek } from './formula';
import { labelled, readAsk, readCheck, type Check } from '../src/tutorial/checks';
import type { Setup } from '../src/tutorial/setup';

export interface TutorialPage {
  id: string;
  title: string;
  html: string;
  setups: Setup[];
  /** Names of the pictures in the HTML, which stand there as src="picture:NAME". */
  pictures: string[];
}

const escape = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const panelKinds = ['space', 'time', 'raster', 'weights', 'wiring', 'camera', 'manipulate', 'sampler', 'trials'];

/** Reads what a comment `<!-- studio ... -->` says: lines of a key, a colon and a value. */
export function readSetup(text: string): Setup {
  const setup: Setup = { title: '', system: '', world: '', set: [], clamp: [], speed: 1, seed: 1, window: 30, panels: [], diagram: '', large: '', choices: [], checks: [], say: '', steps: [] };
  for (const line of text.split('\n').map((l) => l.trim()).filter(Boolean)) {
    const [, key, value] = /^(\w+): *(.+)$/.exec(line) ?? [];
    if (!key || !value) throw new Error(`'${line}' is not a key, a colon and a value`);
    if (key === 'title' || key === 'system' || key === 'world' || key === 'diagram' || key === 'large') setup[key] = value;
    else if (key === 'set' || key === 'clamp') setup[key].push(value);
    else if (key === 'speed') {
      setup.speed = value === 'max' ? 0 : Number(value);
      if (!(setup.speed >= 0)) throw new Error(`'${value}' is not a speed: a number, or max`);
    } else if (key === 'seed' || key === 'window') {
      setup[key] = Number(value);
      if (!Number.isSafeInteger(setup[key]) || setup[key] < 1) throw new Error(`'${value}' is not a whole number from 1 up, for '${key}'`);
      if (key === 'window' && ![10, 30, 120, 600].includes(setup.window)) throw new Error(`'${value}' seconds are no span of a plot: 10, 30, 120 or 600`);
    } else if (key === 'say') setup.say = `${setup.say} ${value}`.trim();
    else if (key === 'step') setup.steps.push(value);
    else if (key === 'choose') {
      const [, assignment, values] = /^(.+?) = (.+)$/.exec(value) ?? [];
      if (!assignment || !values) throw new Error(`'${value}' is not a parameter, ' = ' and values`);
      setup.choices.push({ assignment, values: values.split(/\s+/) });
    } else if (key === 'space') {
      const [, item, low, high] = /^(.+) from (\S+) to (\S+)$/.exec(value) ?? [];
      if (item && !(Number(low) < Number(high))) throw new Error(`'${value}' has no scale: two numbers, the lower one first`);
      setup.panels.push(item ? { kind: key, item, scale: [Number(low), Number(high)] } : { kind: key, item: value });
    } else if (key === 'check') setup.checks.push(readCheck(value));
    else if (key === 'trials' || key === 'seconds') {
      if (!/^[1-9]\d*$/.test(value)) throw new Error(`'${value}' is not a number of ${key}`);
      setup.panels.push({ kind: 'trials', item: value, key });
    } else if (key === 'until') setup.panels.push({ kind: 'trials', item: value, key });
    else if (panelKinds.includes(key)) setup.panels.push({ kind: key, item: value });
    else throw new Error(`'${key}' is not a key of a set-up`);
  }
  if (!setup.system || !setup.world) throw new Error('a set-up names a system and a world');
  // Without a name, the diagram shows the process of the first plot.
  setup.diagram ||= setup.panels.flatMap((p) => /^([^/]+)\//.exec(p.item)?.[1] ?? [])[0] ?? '';
  if (!setup.diagram) throw new Error('a set-up has a plot of a group, or names the process of the diagram');
  if (setup.large && !['arena', 'diagram', ...setup.panels.map((p) => p.kind)].includes(setup.large)) throw new Error(`'${setup.large}' is no panel of the set-up`);
  return setup;
}

const setupComment = /^<!-- studio\n/gm;
/** A question in the text, with the comment in front that says its answer, and the list of what one chooses from. */
const question = /^<!-- ask: (.+) -->\n(.+(?:\n.+)*)\n(?:\n((?:- .+\n)+))?/gm;
/** A question with its field: a number, at most so many where trials are counted, or one of `options`. The page makes the fields for numbers. */
function askHtml({ asked }: Check, text: string, options: string[], name: string): string {
  const fields = options.map((o, i) => `<label><input type="radio" name="${name}" value="${i + 1}"><span>${inline(o)}</span></label>`);
  return `<fieldset class="ask"><legend>${inline(text)}</legend>${fields.join('') || `<label>Your number <span data-number="${asked && 'count' in asked ? asked.count.last : ''}"></span></label>`}</fieldset>`;
}
/** Takes the questions out of the text. Returns those of each set-up, which stand behind it. */
function takeQuestions(markdown: string): { text: string; questions: { check: Check; html: string }[][] } {
  const questions = [...markdown.matchAll(setupComment)].map(() => [] as { check: Check; html: string }[]);
  const text = markdown.replace(question, (_, ask: string, words: string, list: string | undefined, offset: number) => {
    const check = readAsk(ask), options = list?.trim().split('\n').map((o) => o.slice(2)) ?? [];
    const of = questions[[...markdown.slice(0, offset).matchAll(setupComment)].length - 1];
    if (!of) throw new Error(`'${ask}' stands behind no set-up`);
    if (check.asked && ('choice' in check.asked ? check.asked.choice > options.length : options.length > 0)) throw new Error(`'${ask}' does not fit the list behind it`);
    of.push({ check, html: askHtml(check, words.replaceAll('\n', ' '), options, `ask-${questions.indexOf(of)}-${of.length}`) });
    return '';
  });
  return { text, questions };
}

function setupHtml(setup: Setup, number: number, questions: string): string {
  const choices = setup.choices.map(
    (c) =>
      `<div class="choices" role="group" aria-label="${escape(c.assignment)}"><span>${escape(c.assignment)}</span> ${
        c.values.map((v) => `<button type="button" class="outlined" data-set="${escape(`${c.assignment}=${v}`)}" aria-label="${escape(`${c.assignment} = ${v}`)}" disabled>${escape(v)}</button>`).join('')
      }</div>`,
  );
  return `<section class="setup" data-setup="${number}" aria-label="${escape(setup.title || `Set-up ${number + 1}`)}"><button type="button" class="primary" data-open="${number}">Set it up</button><small>${escape(setup.system)} in ${
    escape(setup.world)
  }</small><p>${inline(setup.say)}</p>${setup.steps.length ? `<ol>${setup.steps.map((s) => `<li>${inline(s)}</li>`).join('')}</ol>` : ''}${choices.join('')}${questions}${setup.checks.length ? checksHtml : ''}</section>\n`;
}
const checksHtml =
  '<div class="checks"><button type="button" class="outlined" data-check disabled>Check what I have seen</button> <button type="button" data-forget hidden>Clear answers and ticks</button><div role="status"><ul></ul></div></div>';
/** The exercises of a page, which lead to their set-ups. */
const listHtml = (setups: Setup[]) => (setups.length ? `<ol class="exercises" aria-label="Exercises">${setups.map((s, i) => `<li data-exercise="${i}"><a href="#${i}" data-to="${i}">${inline(s.title)}</a></li>`).join('')}</ol>\n` : '');
const inline = (text: string) => new Marked({ renderer: { html: ({ text }) => escape(text) } }).parseInline(text) as string;

/** `id` is the name of the file without `.md`, `ids` those of all pages. Throws when the text has HTML that is not known here. */
export function makePage(id: string, markdown: string, ids: string[]): TutorialPage {
  const page: TutorialPage = { id, title: '', html: '', setups: [], pictures: [] };
  const { text: body, questions } = takeQuestions(markdown);
  let folded = 0;
  /** The last heading, or question, which names the set-ups behind it that have no title. */
  let heading = '';
  // Formulas have letters where parameters have names: the first mention of a name says which.
  const named = new Set<string>();
  const marked = new Marked({
    renderer: {
      heading({ tokens, depth, text: words }) {
        const text = this.parser.parseInline(tokens);
        if (depth === 1) page.title = text;
        heading = words;
        return `<h${depth + 1}>${text}</h${depth + 1}>\n`;
      },
      paragraph({ tokens, text }) {
        heading = /^\*\*(Q\d[^]*?[?.:](?= |\*\*|$)[^]*?\?)/.exec(text)?.[1]?.replaceAll('\n', ' ') ?? heading;
        return `<p>${this.parser.parseInline(tokens)}</p>\n`;
      },
      html({ text }) {
        const html = text.trim();
        const setup = /^<!-- studio\n([\s\S]*)-->$/.exec(html);
        if (setup) {
          if (folded) throw new Error(`${id}: a set-up stands outside of what is folded`);
          const number = page.setups.length, read = readSetup(setup[1]!), asked = questions[number]!;
          read.checks = labelled([...asked.map((q) => q.check), ...read.checks]);
          read.title ||= heading;
          page.setups.push(read);
          return setupHtml(read, number, asked.map((q) => q.html).join(''));
        }
        const aside = /^<!-- aside: (.+) -->$/.exec(html)?.[1];
        if (aside) return `<!--${escape(aside)}-->`;
        if (/^<!--[\s\S]*-->$/.test(html)) return '';
        if (!/^(<details>|<\/details>|<summary>[^<]*<\/summary>|\s)+$/.test(html)) throw new Error(`${id}: the HTML '${html}' is not shown in the studio`);
        folded += (html.match(/<details>/g)?.length ?? 0) - (html.match(/<\/details>/g)?.length ?? 0);
        return `${html}\n`;
      },
      image({ href, text }) {
        const name = /^pictures\/([\w.-]+)$/.exec(href)?.[1];
        if (!name) throw new Error(`${id}: '${href}' is not a picture of the tutorial`);
        page.pictures.push(name);
        return `<button type="button" class="picture" title="Enlarge"><img src="picture:${name}" alt="${escape(text)}" loading="lazy"></button>`;
      },
      // Pictures side by side would be too small to read: each is as wide as the text.
      table({ header, rows }) {
        if (!rows.every((row) => row.every((c) => c.tokens.length === 1 && c.tokens[0]!.type === 'image'))) return false;
        return rows.map((row) => row.map((c, i) => `<figure><figcaption>${this.parser.parseInline(header[i]!.tokens)}</figcaption>${this.parser.parseInline(c.tokens)}</figure>\n`).join('')).join('');
      },
      link({ href, tokens }) {
        const text = this.parser.parseInline(tokens);
        const to = href.replace(/\.md$/, '');
        if (ids.includes(to)) return `<a href="#${to}" data-part="${to}">${text}</a>`;
        return /^https:\/\//.test(href) ? `<a href="${escape(href)}" target="_blank" rel="noreferrer">${text}</a>` : text;
      },
      codespan({ text }) {
        const letter = named.has(text) ? undefined : greek[text];
        named.add(text);
        return `${letter ? `<i>${letter}</i>, ` : ''}<code>${escape(text)}</code>`;
      },
      code({ text, lang }) {
        const set = lang ? null : formulas(text);
        if (set) return set;
        const code = `<pre tabindex="0"><code>${escape(text)}</code></pre>`;
        if (lang !== 'sh') return `${code}\n`;
        return `<details class="shell"><summary>In a shell</summary>${code}</details>\n`;
      },
    },
  });
  const html = marked.parse(body) as string;
  // What is for a shell or a text editor is folded: here one has the studio.
  const asides = html.replace(/<!--(.*?)-->\n?(<p>[\s\S]*?<\/p>)/g, '<details class="shell"><summary>$1</summary>$2</details>');
  const listed = asides.replace('</h2>\n', () => `</h2>\n${listHtml(page.setups)}`);
  page.html = listed.replace(/<table>/g, '<div class="table" tabindex="0"><table>').replace(/<\/table>/g, '</table></div>');
  return page;
}
