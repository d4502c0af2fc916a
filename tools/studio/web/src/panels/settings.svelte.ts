// The settings of a panel, which its layout keeps.
import { adapt, extent, type Scale, type ScaleMode } from '../draw/scale';
import { activityScale } from '../stores/activity_scales';
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
  /** Until the user chooses another one. */
  private mode: ScaleMode | null;
  private readonly keep: PanelProps['keep'];

  /** `signed`: values below 0 get the diverging map, with 0 in its middle, unless the user chose others. `activityOf`: the group whose activity is shown, unless it is something else. */
  constructor(props: () => Kept, private readonly options: { scale?: Scale; signed?: boolean; activityOf?: () => string | null } = {}) {
    const { panel, keep } = props();
    this.scale = (panel.scale as Scale | undefined) ?? options.scale ?? this.scale;
    this.mode = panel.scale ? null : this.scale.mode;
    this.chosen = panel.map as MapName | undefined;
    this.keep = keep;
  }
  get map(): MapName {
    return this.chosen ?? (this.options.signed && this.scale.low < 0 ? 'diverging' : 'viridis');
  }
  set map(map: MapName) {
    this.chosen = map;
    this.keep({ map });
  }
  /** Lets the scale follow values, as its mode says. */
  follow(...values: ArrayLike<number>[]): void {
    const ends = values.map(extent), least = Math.min(...ends.map((e) => e[0])), largest = Math.max(...ends.map((e) => e[1]));
    const group = this.options.activityOf?.(), shared = group && (this.mode || this.scale.mode === 'expand');
    const { mode, low, high } = shared ? activityScale(group, least, largest) : adapt({ ...this.scale, mode: this.mode ?? this.scale.mode }, least, largest);
    const limit = this.options.signed && mode === 'auto' && low < 0 ? Math.max(-low, high) : null;
    const next = limit === null ? { mode, low, high } : { mode, low: -limit, high: limit };
    if (next.mode !== this.scale.mode || next.low !== this.scale.low || next.high !== this.scale.high) this.scale = next;
  }
  rescale(scale: Scale): void {
    this.scale = scale;
    this.mode = null;
    this.keep({ scale });
  }
}
