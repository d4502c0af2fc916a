// How plots name what they show: by what the cells stand for, as figures of the library do.
import { cellName } from '../draw/cell_names';
import { model, outputState } from '../stores/model.svelte';
import { parseSource } from './sources';

/** The name of a source, its group, and the place that tells it from others of the same name; empty for none. */
function named(source: string): Record<'group' | 'name' | 'place', string> {
  const parsed = parseSource(source, model.groups.map((g) => g.path)), group = parsed && model.group(parsed.item);
  const bare = { group: '', name: source, place: '' };
  if (!parsed || !group || (parsed.state && parsed.state !== outputState(group))) return bare;
  const one = /^(\d+)(?:,(\d+))?$/.exec(parsed.cells);
  if (one) {
    const [x, y] = [Number(one[1]), Number(one[2] ?? 1)], name = group.places ? '' : cellName(group.names, x, y);
    return name ? { group: group.name, name, place: `(${x}, ${y})` } : bare;
  }
  // The mean of one cell is its value.
  return parsed.mean && group.cells === 1 && !parsed.cells ? { group: group.name, name: group.name, place: '' } : bare;
}

/** The titles of sources that stand together: names of different groups have the group before them. */
export function sourceTitles(sources: string[]): string[] {
  const all = sources.map(named), groups = new Set(all.filter((n) => n.group).map((n) => n.group));
  const titles = all.map((n) => (n.group && n.group !== n.name && groups.size > 1 ? `${n.group}: ${n.name}` : n.name));
  return titles.map((title, i) => (titles.filter((t) => t === title).length > 1 && all[i]!.place ? `${title} ${all[i]!.place}` : title));
}

/** The title of a plot of these sources: that of a single one, with its group, or the group of all. Empty for others. */
export function plotTitle(sources: string[]): string {
  const all = sources.map(named), { group = '', name = '' } = all[0] ?? {};
  if (all.length === 1) return group && group !== name ? `${group}: ${name}` : name;
  return all.every((n) => n.group === group) ? group : '';
}
