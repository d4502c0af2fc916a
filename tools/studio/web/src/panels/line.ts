// The line of a connection as its file draws it: from a point at the border of a box, over vertices, to a point at another one.
export type Point = { x: number; y: number };
export type Box = Point & { width: number; height: number };

/** One of 16 points around a box, four on each side: above, right, below, left; numbered to the right and downwards. */
export function anchor(box: Box, number: number): Point {
  const part = ((number % 4) + 0.5) / 4;
  const side = Math.floor(number / 4) % 4;
  if (side % 2 === 0) return { x: box.x + part * box.width, y: box.y + (side === 0 ? 0 : box.height) };
  return { x: box.x + (side === 1 ? box.width : 0), y: box.y + part * box.height };
}

/** The path of an SVG through points, its corners rounded by at most `radius`. */
export function roundedPath(points: Point[], radius = 8): string {
  const at = (p: Point) => `${+p.x.toFixed(2)} ${+p.y.toFixed(2)}`;
  let path = `M${at(points[0]!)}`;
  for (let i = 1; i + 1 < points.length; i++) {
    const [before, corner, after] = [points[i - 1]!, points[i]!, points[i + 1]!];
    const towards = (p: Point) => {
      const length = Math.hypot(p.x - corner.x, p.y - corner.y) || 1;
      const part = Math.min(radius, length / 2) / length;
      return { x: corner.x + part * (p.x - corner.x), y: corner.y + part * (p.y - corner.y) };
    };
    path += `L${at(towards(before))}Q${at(corner)} ${at(towards(after))}`;
  }
  return `${path}L${at(points[points.length - 1]!)}`;
}

/** The part of a line that is the nearest to a point, and how far it is. */
export function nearestPart(points: Point[], p: Point): { part: number; distance: number } {
  let part = 0, distance = Infinity;
  for (let i = 0; i + 1 < points.length; i++) {
    const [a, b] = [points[i]!, points[i + 1]!];
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const t = Math.max(0, Math.min(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy || 1)));
    const d = Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
    if (d < distance) [part, distance] = [i, d];
  }
  return { part, distance };
}

/** The middle of the longest part of a line. */
export function middleOfLongest(points: Point[]): Point {
  let best = 0;
  const length = (i: number) => Math.hypot(points[i + 1]!.x - points[i]!.x, points[i + 1]!.y - points[i]!.y);
  for (let i = 1; i + 1 < points.length; i++) if (length(i) > length(best)) best = i;
  return { x: (points[best]!.x + points[best + 1]!.x) / 2, y: (points[best]!.y + points[best + 1]!.y) / 2 };
}
