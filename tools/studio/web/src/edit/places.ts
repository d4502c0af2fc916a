// Places and names of new or moved boxes.

export type Edge = 'left' | 'right' | 'top' | 'bottom' | 'column' | 'row';
export type Placed = { id: string; x: number; y: number; width: number; height: number };

/** New places of boxes, so that an edge or the middle of all is on one line. */
export function aligned(boxes: Placed[], side: Edge): Placed[] {
  const min = (f: (b: Placed) => number) => Math.min(...boxes.map(f));
  const max = (f: (b: Placed) => number) => Math.max(...boxes.map(f));
  const mean = (f: (b: Placed) => number) => boxes.reduce((a, b) => a + f(b), 0) / boxes.length;
  const move: Record<Edge, (b: Placed) => Placed> = {
    left: (b) => ({ ...b, x: min((o) => o.x) }),
    right: (b) => ({ ...b, x: max((o) => o.x + o.width) - b.width }),
    top: (b) => ({ ...b, y: min((o) => o.y) }),
    bottom: (b) => ({ ...b, y: max((o) => o.y + o.height) - b.height }),
    column: (b) => ({ ...b, x: Math.round(mean((o) => o.x + o.width / 2) - b.width / 2) }),
    row: (b) => ({ ...b, y: Math.round(mean((o) => o.y + o.height / 2) - b.height / 2) }),
  };
  return boxes.map(move[side]);
}

/** New places of boxes with equal steps between the outermost ones. */
export function distributed(boxes: Placed[], axis: 'x' | 'y'): Placed[] {
  const sorted = [...boxes].sort((a, b) => a[axis] - b[axis]);
  const first = sorted[0]![axis], last = sorted[sorted.length - 1]![axis];
  return sorted.map((b, i) => ({ ...b, [axis]: Math.round(first + ((last - first) * i) / (sorted.length - 1)) }));
}

/** A place at or below to the right of `at`, at which a box covers none of the others. */
export function apart(at: [number, number], boxes: [number, number][]): [number, number] {
  const near = ([x, y]: [number, number]) => boxes.some((b) => Math.abs(b[0] - x) < 50 && Math.abs(b[1] - y) < 50);
  let [x, y] = at;
  while (near([x, y])) (x += 30), (y += 30);
  return [x, y];
}

/** A name that none of the others has: "Group 3". */
export function freshName(stem: string, names: string[]): string {
  const taken = new Set(names);
  let n = 1;
  while (taken.has(`${stem} ${n}`)) n++;
  return `${stem} ${n}`;
}
