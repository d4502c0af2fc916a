import { describe, expect, it } from 'vitest';
import { shrunk } from '../../src/draw/heat';
import { csv, heatsSvg, linesSvg } from '../../src/draw/save';
import { adapt, axisScale, extent, short } from '../../src/draw/scale';
import { cyclesPerRow, Trace } from '../../src/panels/trace';

describe('scales', () => {
  it('auto follows, expand only grows, manual stays', () => {
    expect(adapt({ mode: 'auto', low: 0, high: 5 }, 0.2, 2)).toEqual({ mode: 'auto', low: 0, high: 2 });
    expect(adapt({ mode: 'expand', low: 0, high: 5 }, -1, 2)).toEqual({ mode: 'expand', low: -1, high: 5 });
    const manual = { mode: 'manual' as const, low: 0, high: 1 };
    expect(adapt(manual, -9, 9)).toBe(manual);
    expect(adapt(manual, ...extent([NaN]))).toBe(manual);
  });
  it('leaves a margin around lines; expand is the widest so far', () => {
    expect(axisScale({ mode: 'auto', low: 0, high: 9 }, 2, 4)).toEqual({ mode: 'auto', low: 1.8, high: 4.2 });
    expect(axisScale({ mode: 'auto', low: 0, high: 9 }, 0, 0)).toEqual({ mode: 'auto', low: 0, high: 1 });
    expect(axisScale({ mode: 'expand', low: 0, high: 9 }, -1, 4)).toEqual({ mode: 'expand', low: -1.5, high: 9 });
    expect(axisScale({ mode: 'manual', low: 0, high: 9 }, -1, 40)).toEqual({ mode: 'manual', low: 0, high: 9 });
  });
  it('writes numbers shortly', () => expect([0, 0.123456, 1e-7, NaN].map(short)).toEqual(['0', '0.1235', '1e-7', '–']));
});

describe('heat maps', () => {
  it('of more cells than a canvas has pixels draw the largest of those that share one', () => {
    const values = [1, 2, 3, NaN, 5, 4, NaN, NaN, 0, 7];
    expect(shrunk(values, 5, 2, 5)).toEqual([values, 5, 2]);
    const [few, columns, rows] = shrunk(values, 5, 2, 3);
    expect([columns, rows, ...Array.from(few)]).toEqual([3, 2, 2, 3, 5, 4, 0, 7]);
  });
});

describe('Trace', () => {
  const block = (rows: number[][], gap = false) => ({ stream: 1, rows: rows.length, columns: rows[0]!.length, gap, joined: false, low: 0, high: 1, values: Float64Array.from(rows.flat()) });
  it('keeps means over time, and marks a gap', () => {
    const t = new Trace();
    t.add(block([[0, 1, 3], [1, 2, 4]]), 1, 0.1);
    t.add(block([[9, 0, 0]], true), 1, 0.1);
    const x = t.times(10);
    expect(x).toEqual([0, 0.1, 0.9, 0.9]);
    expect(t.at([0, 0.1])).toEqual([2, 3]);
  });
  it('draws the extremes of several cycles in their order, and knows the mean of every cycle', () => {
    const t = new Trace();
    t.add({ ...block([[0, 4, 1, 9, 2], [4, 2, 8, 2, 5]]), joined: true }, 1, 0.1);
    t.add(block([[4, 3], [8, 7]]), 1, 0.1); // the first is shown already
    expect(t.times(10)).toEqual([0, 0.2, 0.4, 0.5, 0.8].map((v) => expect.closeTo(v)));
    expect(t.at(t.times(10))).toEqual([1, 9, 8, 2, 7]);
    expect(t.meanOf(0, 0.6)).toBeCloseTo((4 * 2 + 2 * 5) / 6);
    expect(t.meanOf(0.4, 1)).toBeCloseTo((2 * 5 + 7) / 3);
    expect(t.meanOf(2, 3)).toBeNaN();
  });
  it('takes as many cycles for a row as a pixel can show', () => {
    expect(cyclesPerRow(30, 0.04, 400)).toBe(1);
    expect(cyclesPerRow(600, 0.04, 400)).toBe(32);
    expect(cyclesPerRow(600, 0.04, 0)).toBe(128);
  });
  it('forgets the future when the run goes back', () => {
    const t = new Trace();
    t.add(block([[0, 1], [1, 1], [2, 1]]), 1, 1);
    t.add({ ...block([[0, 0]]), rows: 0 }, 2, 1); // the run rests after it has gone back
    expect(t.length).toBe(3);
    t.add(block([[1, 5]]), 2, 1);
    expect(t.times(10)).toEqual([0, 1]);
    expect(t.at([0, 1])).toEqual([1, 5]);
  });
});

describe('files', () => {
  it('quotes names in CSV', () => expect(csv(['s', 'a,b'], [[0, NaN]])).toBe('s,"a,b"\n0,nan\n'));
  it('writes words beside numbers in CSV', () => expect(csv(['run', 'a'], [['as, it was', 0.5], ['now', NaN]])).toBe('run,a\n"as, it was",0.5\nnow,nan\n'));
  it('places heat maps side by side or one below the other, with captions that do not overlap', () => {
    const svg = (row: boolean, columns = 2, rows = 2) => heatsSvg(['now', 'as it was'].map((caption) => ({ columns, rows, caption, colour: (i) => `rgb(${i} 0 0)` })), row);
    expect(svg(true)).toContain('viewBox="0 0 976 502"');
    expect(svg(false)).toContain('viewBox="0 0 480 1020"');
    expect([...svg(true).matchAll(/translate\(([\d. ]+)\) scale\(240\)/g)].map((m) => m[1])).toEqual(['0 0', '496 0']);
    expect(svg(true).match(/<rect /g)).toHaveLength(8);
    const middles = [...svg(true, 1, 80).matchAll(/<text x="([\d.]+)" y="496"/g)].map((m) => Number(m[1]));
    expect(middles[1]! - middles[0]!).toBeGreaterThan(80);
  });
  it('places heat maps of two sizes with equal cells, without squares where there is nothing', () => {
    const svg = heatsSvg([{ columns: 2, rows: 1, caption: 'a', colour: () => 'red' }, { columns: 4, rows: 4, caption: '<b>', colour: (i) => (i ? 'none' : 'blue') }], true);
    expect(svg).toContain('viewBox="0 0 736 502"');
    expect([...svg.matchAll(/translate\(([\d. ]+)\) scale\(120\)/g)].map((m) => m[1])).toEqual(['0 0', '256 0']);
    expect(svg.match(/<rect /g)).toHaveLength(3);
    expect(svg).toContain('&lt;b&gt;');
  });
  it('breaks lines where there is no value', () => expect(linesSvg([0, 1, 2], [{ label: '<x>', colour: '#000', y: [1, NaN, 2] }])).toMatch(/&lt;x&gt;.*d="M[\d. ]+M[\d. ]+"/));
  it('gives keys without room in one row another row', () => {
    const keys = linesSvg([0, 1], ['a', 'b'].map((c) => ({ label: c.repeat(60), colour: '#000', y: [0, 1] })));
    expect(keys.match(/<text x="56" y="(0|14)"/g)).toHaveLength(2);
    expect(keys).toContain('viewBox="0 -14 800 334"');
  });
});
