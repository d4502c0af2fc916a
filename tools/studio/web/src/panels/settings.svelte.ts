// The settings of a panel, which its layout keeps.
import { adapt, extent, type Scale } from '../draw/scale';
import type { MapName } from '../draw/colours';
import type { PanelProps } from './registry';

type Kept = Pick<PanelProps, 'panel' | 'keep'>;

/** Values that begin as the layout has them. Assigning one keeps it in the layout. */
export function settings<T extends object>(props: () => Kept, defaults: T): T {
  const { panel, keep } = props(), out = {} as T;
  for (const key of Object.keys(defaults) as (keyof T & string)[]) {
    let value = $state.raw((panel[key] as T[typeof key] | undefined) ?? defaults[key]);
    Object.defineProperty(out, key, {
      enumerable: true,
      get: () => value,
      set(next) {
        value = next;
        keep({ [key]: next });
      },
    });
  }
  return out;
}

/** The scale and the map of a plot's colours. Only what the user chooses is kept in the layout. */
export class PlotColours {
  scale = $state.raw<Scale>({ mode: 'auto', low: 0, high: 1 });
  private chosen = $state.raw<MapName>();
  private readonly keep: PanelProps['keep'];

  /** `signed`: values below 0 get the diverging map, with 0 in its middle, unless the user chose others. */
  constructor(props: () => Kept, scale?: Scale, private readonly signed = false) {
    const { panel, keep } = props();
    this.scale = (panel.scale as Scale | undefined) ?? scale ?? this.scale;
    this.chosen = panel.map as MapName | undefined;
    this.keep = keep;
  }
  get map(): MapName {
    return this.chosen ?? (this.signed && this.scale.low < 0 ? 'diverging' : 'viridis');
  }
  set map(map: MapName) {
    this.chosen = map;
    this.keep({ map });
  }
  /** Lets the scale follow values, as its mode says. */
  follow(...values: ArrayLike<number>[]): void {
    const ends = values.map(extent);
    const { mode, low, high } = adapt(this.scale, Math.min(...ends.map((e) => e[0])), Math.max(...ends.map((e) => e[1])));
    const limit = this.signed && mode === 'auto' && low < 0 ? Math.max(-low, high) : null;
    const next = limit === null ? { mode, low, high } : { mode, low: -limit, high: limit };
    if (next.low !== this.scale.low || next.high !== this.scale.high) this.scale = next;
  }
  rescale(scale: Scale): void {
    this.scale = scale;
    this.keep({ scale });
  }
}
