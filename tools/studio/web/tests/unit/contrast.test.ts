import { expect, it } from 'vitest';
import css from '../../src/app.css?raw';

const blocks = [...css.matchAll(/:root(\.dark)? \{([^}]*)\}/g)].map((m) => [m[1] ? 'dark' : 'light', Object.fromEntries([...m[2]!.matchAll(/--([\w-]+): ([^;]+);/g)].map((v) => [v[1], v[2]]))] as const);
const rgb = (hex: string) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
/** The luminance of a colour, as WCAG 2 has it. */
const luminance = (colour: number[]) => colour.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i]!, 0);
function contrast(a: number[], b: number[]): number {
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}

it.each(blocks)('lines of the diagram are seen on its %s ground, those that are not chosen, too', (_, of) => {
  const ground = rgb(of.panel!), share = Number(of.unchosen);
  for (const kind of ['excite', 'inhibit', 'modulate']) expect(contrast(rgb(of[kind]!).map((c, i) => share * c + (1 - share) * ground[i]!), ground), kind).toBeGreaterThanOrEqual(3);
});
it('both grounds are looked at', () => expect(blocks.map(([name]) => name)).toEqual(['light', 'dark']));
