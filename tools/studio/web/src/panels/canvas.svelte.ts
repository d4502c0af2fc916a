// What can be done with the diagram from outside of its panel, while it is open.
export interface CanvasApi {
  save(kind: 'svg' | 'png'): void;
  print(): void;
  fit(): void;
  turn(split: 'columns' | 'rows' | null): void;
}
class Canvas {
  api = $state.raw<CanvasApi | null>(null);
}
export const canvas = new Canvas();
