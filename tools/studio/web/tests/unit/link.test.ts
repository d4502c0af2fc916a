import { describe, expect, it } from 'vitest';
import { fragmentOf, linkedIn } from '../../src/browser/link';

const linked = { name: 'forager', system: '<System name="ä">'.repeat(500), world: '/forage/systems/worlds/basic_arena.world' };

describe('a link', () => {
  it('holds a system in few letters', async () => {
    const fragment = await fragmentOf(linked);
    expect(fragment.length).toBeLessThan(400);
    expect(await linkedIn(`#${fragment}`)).toEqual(linked);
  });
  it('is another fragment, or none', async () => {
    expect(await linkedIn('')).toBeNull();
    expect(await linkedIn('#2-reactive-layer')).toBeNull();
  });
  it('that is damaged says so', async () => {
    const fragment = await fragmentOf(linked);
    for (const damaged of [fragment.slice(0, 60), 'system=AAAA', await fragmentOf({ ...linked, system: 5 as unknown as string }), await fragmentOf('x' as never)])
      await expect(linkedIn(damaged)).rejects.toThrow('The system in this link cannot be read');
  });
  it('that would fill the memory is refused, and not made', async () => {
    const spaces = ' '.repeat(5 << 20);
    await expect(fragmentOf({ ...linked, system: spaces })).rejects.toThrow('too large');
    const packed = new Uint8Array(await new Response(new Blob([spaces]).stream().pipeThrough(new CompressionStream('deflate-raw'))).arrayBuffer());
    const fragment = `system=${btoa(String.fromCharCode(...packed)).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '')}`;
    await expect(linkedIn(fragment)).rejects.toThrow('too much');
  });
});
