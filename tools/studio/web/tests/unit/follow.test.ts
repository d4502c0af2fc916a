import { describe, expect, it } from 'vitest';
import type { SystemMessage } from '../../src/protocol/messages';
import { renamedSource } from '../../src/panels/sources';
import { followed, idsByName, nameChanges, shows } from '../../src/stores/follow';

const system = (groups: Record<string, string>, connections: Record<string, string> = {}, process = 'Bug') =>
  ({
    processes: [{ id: 'p', name: process, groups: Object.entries(groups).map(([id, name]) => ({ id, path: `${process}/${name}` })) }],
    connections: Object.entries(connections).map(([id, name]) => ({ id, name })),
  }) as unknown as SystemMessage;

describe('panels', () => {
  it('keep to an item with another name', () => {
    const changes = nameChanges(system({ a: 'Light', b: 'US' }, { c: 'wire' }), system({ a: 'Lamp', b: 'US' }, { c: 'cable' }));
    expect(followed({ kind: 'space', item: 'Bug/Light', state: 'vm' }, changes)).toEqual({ kind: 'space', item: 'Bug/Lamp', state: 'vm' });
    expect(followed({ kind: 'weights', item: 'wire' }, changes)).toEqual({ kind: 'weights', item: 'cable' });
    expect(followed({ kind: 'time', sources: ['mean(Bug/Light:vm(1,2))', 'Bug/US', 'wire:weight'] }, changes)).toEqual({ kind: 'time', sources: ['mean(Bug/Lamp:vm(1,2))', 'Bug/US', 'cable:weight'] });
    expect(followed({ kind: 'chosen', rows: [{ item: 'Bug/Light', parameter: 'p' }] }, changes)).toEqual({ kind: 'chosen', rows: [{ item: 'Bug/Lamp', parameter: 'p' }] });
    const same = { kind: 'space', item: 'Bug/US' };
    expect(followed(same, changes)).toBe(same);
  });
  it('know a source by the id of its item, which another name does not change', () => {
    const before = system({ a: 'Light', b: 'US' }, { c: 'wire' }), after = system({ a: 'US', b: 'Light' }, { c: 'cable' }, 'Robot');
    const sources = ['mean(Bug/Light:vm(1,2))', 'Bug/US', 'wire:weight', 'Bug/Gone'], names = idsByName(before);
    expect(sources.map((s) => renamedSource(s, names))).toEqual(['mean(a:vm(1,2))', 'b', 'c:weight', 'Bug/Gone']);
    const { sources: next } = followed({ kind: 'time', sources }, nameChanges(before, after)) as { sources: string[] };
    expect(next.map((s) => renamedSource(s, idsByName(after)))).toEqual(sources.map((s) => renamedSource(s, names)));
  });
  it('follow a process, and two groups that change their names with each other', () => {
    expect(followed({ kind: 'raster', item: 'Bug/Light' }, nameChanges(system({ a: 'Light' }), system({ a: 'Light' }, {}, 'Robot')))).toEqual({ kind: 'raster', item: 'Robot/Light' });
    const swap = nameChanges(system({ a: 'Light', b: 'US' }), system({ a: 'US', b: 'Light' }));
    expect(followed({ kind: 'time', sources: ['Bug/Light', 'Bug/US'] }, swap)).toEqual({ kind: 'time', sources: ['Bug/US', 'Bug/Light'] });
  });
  it('close with what they show, and keep the rest of what they show', () => {
    const changes = nameChanges(system({ a: 'Light', b: 'US' }), system({ b: 'US' }));
    for (const panel of [{ kind: 'space', item: 'Bug/Light' }, { kind: 'manipulate', item: 'a' }, { kind: 'time', sources: ['mean(Bug/Light)'] }]) expect(followed(panel, changes)).toBe('a');
    expect(followed({ kind: 'time', sources: ['mean(Bug/Light)', 'mean(Bug/US)'] }, changes)).toEqual({ kind: 'time', sources: ['mean(Bug/US)'] });
    expect(followed({ kind: 'sampler', sources: ['Bug/Light'] }, changes)).toEqual({ kind: 'sampler', sources: [] });
    expect(followed({ kind: 'chosen', rows: ['a', 'Bug/Light', 'b'].map((item) => ({ item, parameter: 'p' })) }, changes)).toEqual({ kind: 'chosen', rows: [{ item: 'b', parameter: 'p' }] });
    expect(followed({ kind: 'camera', item: 'Bug/Light' }, changes)).toEqual({ kind: 'camera', item: 'Bug/Light' });
  });
  it('tell whether they show an item', () => {
    const names = new Set(['a', 'Bug/Light']);
    for (const panel of [{ kind: 'space', item: 'Bug/Light' }, { kind: 'raster', item: 'a' }, { kind: 'time', sources: ['Bug/US', 'mean(Bug/Light:vm(1,1))'] }]) expect(shows(panel, names)).toBe(true);
    for (const panel of [{ kind: 'space', item: 'Bug/US' }, { kind: 'time', sources: ['mean(Bug/US)'] }, { kind: 'diagram' }, { kind: 'camera', item: 'a' }]) expect(shows(panel, names)).toBe(false);
  });
  it('do not follow an item of another kind', () => {
    const changes = nameChanges(system({ a: 'Light' }, { c: 'Camera' }, 'Camera'), system({ a: 'Light' }, { c: 'Camera' }, 'Eye'));
    const wiring = { kind: 'wiring', item: 'Camera' };
    expect(followed(wiring, changes)).toBe(wiring);
    expect(followed({ kind: 'wiring', item: 'Camera' }, nameChanges(system({}, { c: 'Camera' }, 'Camera'), { processes: [], connections: [{ id: 'c', name: 'Camera' }] } as unknown as SystemMessage))).toEqual(wiring);
  });
  it('do not follow one of two items of the same name, and are named by the id when theirs is no longer the only one', () => {
    const wiring = { kind: 'wiring', item: 'wire' }, byId = { kind: 'weights', item: 'd' };
    const renamed = nameChanges(system({}, { c: 'wire', d: 'wire' }), system({}, { c: 'wire', d: 'cable' }));
    for (const panel of [wiring, byId]) expect(followed(panel, renamed)).toBe(panel);
    const removed = nameChanges(system({}, { c: 'wire', d: 'wire' }), system({}, { c: 'wire' }));
    expect([followed(wiring, removed), followed(byId, removed), followed({ kind: 'time', sources: ['d:weight(1,1)'] }, removed)]).toEqual([wiring, 'd', 'd']);
    const second = nameChanges(system({}, { c: 'wire', d: 'cable' }), system({}, { c: 'wire', d: 'wire' }));
    expect(followed(wiring, second)).toEqual({ kind: 'wiring', item: 'c' });
    expect(followed({ kind: 'time', sources: ['cable:weight(1,1)'] }, second)).toEqual({ kind: 'time', sources: ['d:weight(1,1)'] });
  });
  it('stay when an item with another id has the name now', () => expect(nameChanges(system({ a: 'Light' }), system({ z: 'Light' }))).toEqual({ names: new Map(), gone: new Map(), lost: new Map([['a', 'Bug/Light']]) }));
});
