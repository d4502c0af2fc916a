import { describe, expect, it, vi } from 'vitest';
import { makePage, readSetup } from '../../tutorial/page';

vi.stubGlobal('matchMedia', () => ({ matches: false }));
vi.stubGlobal('location', { protocol: 'http:', host: 'x' });
const { clampPattern } = await import('../../src/tutorial/setup');

const page = (markdown: string) => makePage('1-first', markdown, ['1-first', '2-second']);

describe('pages of the tutorial', () => {
  it('have the title, the text, folded solutions and pictures', () => {
    const made = page('# Title\n\nSome *text* & more.\n\n<details><summary>Solution</summary>\n\nIt **is**.\n![An arena](pictures/1.png)\n</details>\n');
    expect(made.title).toBe('Title');
    expect(made.pictures).toEqual(['1.png']);
    expect(made.html).toContain('<h2>Title</h2>');
    expect(made.html).toMatch(/<p>Some <em>text<\/em> &amp; more\.<\/p>\n<details><summary>Solution<\/summary>\n<p>It <strong>is<\/strong>/);
    expect(made.html).toContain('<img src="picture:1.png" alt="An arena" loading="lazy">');
    expect(made.html.trim().endsWith('</details>')).toBe(true);
  });
  it('have pictures of a table one below the other, each below its heading', () => {
    const { html } = page('| a *b* | c |\n|---|---|\n| ![A](pictures/1.png) | ![C](pictures/2.png) |\n\n| d |\n|---|\n| 1 |\n');
    expect(html).toMatch(/^<figure><figcaption>a <em>b<\/em><\/figcaption><button [^>]*><img src="picture:1.png"[^]*<figcaption>c<\/figcaption><button [^>]*><img src="picture:2.png"/);
    expect(html.match(/<table>/g)).toHaveLength(1);
  });
  it('have formulas as MathML, each with its meaning, in terms between which lines may break', () => {
    const { html } = page("A:\n\n    y = W'x          the prediction\n    W += eta [ (x - 2)' + rho e ]\n\n`eta` is a rate, `eta` again.\n");
    expect(html).toContain('<math><mi>y</mi><mo form="infix">=</mo><msup><mi>W</mi><mi mathvariant="normal">T</mi></msup><mi>x</mi></math></p><span>the prediction</span>');
    expect(html).toContain(
      '<mo form="infix">+=</mo><mi>η</mi><mo stretchy="false" lspace="0" rspace="0">[</mo><mo stretchy="false" lspace="0" rspace="0">(</mo><mi>x</mi><mo form="infix">−</mo><mn>2</mn><msup><mo stretchy="false" lspace="0" rspace="0">)</mo><mi mathvariant="normal">T</mi></msup></math> <math><mo form="infix">+</mo><mi>ρ</mi><mi>e</mi><mo stretchy="false" lspace="0" rspace="0">]</mo></math>',
    );
    expect(html).toContain('<i>η</i>, <code>eta</code> is a rate, <code>eta</code> again');
    expect(page('    other = text; here\n').html).toContain('<pre');
  });
  it('link to other parts; links to other documents are plain text', () => {
    expect(page('[two](2-second.md), [types](../types.md), [web](https://x.org/?a&b)').html.trim()).toBe(
      '<p><a href="#2-second" data-part="2-second">two</a>, types, <a href="https://x.org/?a&#38;b" target="_blank" rel="noreferrer">web</a></p>',
    );
  });
  it('do not pass on other HTML', () => {
    for (const bad of ['<script>alert(1)</script>', 'a <b onclick="x()">b</b>', '<details open onclick="x()">', '<summary><img src=x onerror=y></summary>']) expect(() => page(bad)).toThrow('is not shown');
    expect(page('[x](javascript:alert(1))').html).not.toContain('href');
    expect(() => page('![x](https://evil/x.png)')).toThrow('not a picture');
  });
  it('have a button for each comment that sets something up', () => {
    const made = page('<!-- studio\nsystem: a.iqr\nworld: b.world\nset: P.x=1\nspeed: max\nchoose: P.y = 0 0.5\nspace: P/G\nsay: Press *Run* <now>.\nstep: First *this*.\nstep: Then that.\n-->\n\n<!-- made by: x -->\n');
    expect(made.setups).toEqual([{
      title: '',
      system: 'a.iqr',
      world: 'b.world',
      set: ['P.x=1'],
      clamp: [],
      speed: 0,
      seed: 1,
      window: 30,
      panels: [{ kind: 'space', item: 'P/G' }],
      diagram: 'P',
      large: '',
      choices: [{ assignment: 'P.y', values: ['0', '0.5'] }],
      checks: [],
      say: 'Press *Run* <now>.',
      steps: ['First *this*.', 'Then that.'],
    }]);
    expect(made.html).toContain('data-open="0">Set it up</button>');
    expect(made.html).toContain('data-set="P.y=0.5" aria-label="P.y = 0.5" disabled>0.5</button>');
    expect(made.html).toContain('Press <em>Run</em> &#60;now&#62;.</p><ol><li>First <em>this</em>.</li><li>Then that.</li></ol>');
    expect(made.html).not.toContain('<!--');
  });
  it('fold what is for a shell or a text editor', () => {
    expect(page('Here.\n\n<!-- aside: In a text editor -->\nCopy `it`.\n\nThere.\n').html).toContain('<p>Here.</p>\n<details class="shell"><summary>In a text editor</summary><p>Copy <code>it</code>.</p></details>\n<p>There.</p>');
  });
  it.each([
    ['system: a.iqr', 'a system and a world'],
    ['system: a\nworld: b\nplot: x', "'plot' is not a key"],
    ['system: a\nworld: b\nchoose: x', 'and values'],
    ['system: a\nworld: b\nspeed: fast', 'not a speed'],
    ['system: a\nworld: b\ntrials: some', 'not a number of trials'],
    ['hello', 'a key, a colon and a value'],
    ['system: a\nworld: b\nspace: P/G\nlarge: raster', 'no panel of the set-up'],
    ['system: a\nworld: b\nspace: P/G\ncheck: some', 'neither'],
    ['system: a\nworld: b\nseed: x', "not a whole number from 1 up, for 'seed'"],
    ['system: a\nworld: b\nwindow: 0.5', 'not a whole number'],
    ['system: a\nworld: b\nwindow: 60', 'no span of a plot'],
    ['system: a\nworld: b\nspace: P/G from 1 to 0', 'the lower one first'],
    ['system: a\nworld: b\nspace: P/G from a to b', 'the lower one first'],
    ['system: a\nworld: b\nweights: A to B', 'the process of the diagram'],
  ])('refuse the set-up %j', (text, message) => expect(() => readSetup(text)).toThrow(message));
  it('say which process the diagram shows, or take that of the first plot', () => {
    const read = (lines: string) => readSetup(`system: a\nworld: b\n${lines}`).diagram;
    expect(read('weights: A to B\ntime: Two words/G(1,1), Other/G')).toBe('Two words');
    expect(read('diagram: Third\nspace: P/G')).toBe('Third');
    expect(read('trials: 30\nspace: P/G')).toBe('P');
  });
  it('may fix the scale of a plot, and say the seed and the seconds that plots over time show', () => {
    const setup = readSetup('system: a\nworld: b\nseed: 3\nwindow: 600\nspace: P/Two words from -0.5 to 0.2\ntime: P/G');
    expect(setup.panels).toEqual([{ kind: 'space', item: 'P/Two words', scale: [-0.5, 0.2] }, { kind: 'time', item: 'P/G' }]);
    expect([setup.seed, setup.window]).toEqual([3, 600]);
  });
  it('have a button that checks what was seen, once the exercise is set up', () => {
    const made = page('<!-- studio\nsystem: a\nworld: b\nspace: P/G\nlarge: arena\nseconds: 600\ncheck: hits 0.5 of 9 trials\n-->\n');
    expect(made.setups[0]).toMatchObject({ large: 'arena', panels: [{ kind: 'space' }, { kind: 'trials', item: '600', key: 'seconds' }], checks: [{ hits: { trials: 9 } }] });
    expect(made.html).toContain('data-check disabled>Check what I have seen</button>');
  });
  const withQuestion = (ask: string, list = '- one\n- *two*\n') => page(`<!-- studio\nsystem: a\nworld: b\nspace: P/G\ncheck: 60 s\n-->\n\n<!-- ask: ${ask} -->\nWhich of\nthem?\n\n${list}\nText.\n`);
  it('take the questions behind a set-up into it, in front of its other checks', () => {
    const made = withQuestion('choice 2; the plot');
    expect(made.setups[0]!.checks).toEqual([{ given: [], asked: { choice: 2, look: 'the plot' } }, { given: [], lasts: 60 }]);
    expect(made.html).toContain('<legend>Which of them?</legend><label><input type="radio" name="ask-0-0" value="1"><span>one</span></label>');
    expect(made.html.indexOf('</fieldset>')).toBeLessThan(made.html.indexOf('</section>'));
    expect(made.html).toMatch(/<p>Text\.<\/p>\s*$/);
    expect(withQuestion('hits of 5 trials; the boxes', '').html).toContain('<span data-number="5">');
  });
  it('refuse a question without its list, or without a set-up', () => {
    expect(() => withQuestion('choice 3; the plot')).toThrow('does not fit the list');
    expect(() => withQuestion('hits of 5 trials; the boxes')).toThrow('does not fit the list');
    expect(() => page('<!-- ask: choice 1; x -->\nWhich?\n\n- one\n')).toThrow('no set-up');
  });
  it('list their exercises, called by a title, or by the question or the heading above', () => {
    const one = '<!-- studio\nsystem: a\nworld: b\nspace: P/G\n-->\n\n', { html } = page(`# T\n\n## Exercise 1: *it*\n\n${one}**Q1, Q2. What is it?\nWrite.** Or?\n\n${one}Some text.\n\n${one.replace('system', 'title: Again\nsystem')}`);
    expect(html).toMatch(/^<h2>T<\/h2>\n<ol class="exercises"/);
    expect([...html.matchAll(/<li data-exercise="(\d)"><a href="#\d" data-to="\d">(.*?)<\/a>/g)].map((m) => m.slice(1))).toEqual([['0', 'Exercise 1: <em>it</em>'], ['1', 'Q1, Q2. What is it?'], ['2', 'Again']]);
  });
  it('refuse a set-up that would be folded away', () => expect(() => page('<details><summary>S</summary>\n\n<!-- studio\nsystem: a\nworld: b\nspace: P/G\n-->\n\n</details>')).toThrow('outside'));
});

describe('docs/tutorial', () => {
  it('becomes pages: all parts in their order, with set-ups and pictures', async () => {
    const { pages } = await import('virtual:tutorial');
    expect(pages.map((p) => p.id.split('-')[0])).toEqual([...pages.keys()].slice(1).map(String).concat('appendix'));
    for (const p of pages.slice(0, 6)) expect(p.setups.length, p.id).toBeGreaterThanOrEqual(3);
    for (const p of pages) expect(p.html).not.toContain('src="picture:');
    for (const { setups } of pages) expect(new Set(setups.map((s) => s.title)).size).toBe(setups.length);
    expect(pages[0]!.html).toMatch(/<img src="[^"]*1-basic-arena\.png"/);
  });
});

describe('what exercises expect', async () => {
  const { pages } = await import('virtual:tutorial');
  const checks = pages.flatMap((p) => p.setups.flatMap((s) => s.checks.map((check) => ({ page: p, setup: s, check }))));
  it('of hits, stands in the text', () => {
    const counted = checks.filter(({ check }) => check.hits && check.hits.deviation > 0);
    expect(counted.length).toBeGreaterThan(20);
    for (const { page: { html, title }, check: { hits } } of counted) {
      const written = (v: number) => `${String(v).replace('.', '\\.')}[.0]*`;
      expect(html, `${title}: ${hits!.share}`).toMatch(new RegExp(`${written(hits!.share)} ± ${written(hits!.deviation)}`));
    }
  });
  it('reads as a task, which says nothing of what is found', () => {
    for (const { setup, check } of checks)
      if (check.seen) expect(check.seen.task, setup.title).toMatch(/^(drive|find|let|make|run) [^%]*$/);
  });
  it('is judged with values that its buttons choose', () => {
    for (const { setup, check } of checks)
      for (const given of check.given) expect(setup.choices.some((c) => c.values.some((v) => given === `${c.assignment}=${v}`)), `${setup.title}: ${given}`).toBe(true);
  });
});

describe('a clamp', () => {
  const size = () => ({ width: 9, cells: 81 });
  it('is a pattern, row by row, counted from 1', () => {
    const { group, pattern } = clampPattern('Bug/Motor(5,2)=0.5', size);
    expect(group).toBe('Bug/Motor');
    expect(pattern.flatMap((v, i) => (v ? [[i, v]] : []))).toEqual([[13, 0.5]]);
  });
  it('of an unknown group is an error', () => expect(() => clampPattern('X(1,1)=1', () => undefined)).toThrow('no cell'));
});
