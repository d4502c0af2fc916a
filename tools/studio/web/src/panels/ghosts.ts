// The robots of the run to compare with: pale, with dashed trails.
import type { RobotInfo } from '../protocol/messages';
import { streams } from '../studio';
import { Trail, type Placed } from './trail';

export class Ghosts {
  private poses: ArrayLike<number> = [];
  private trails: Trail[] = [];

  /** Subscribes to the robots of the reference; `redraw` is called when there is something new. Returns what ends it. */
  watch(robots: RobotInfo[], redraw: () => void): () => void {
    this.trails = robots.map(() => new Trail());
    const ends = [streams.subscribe('reference:world:poses', 'latest', (block) => ((this.poses = block.values), redraw()))];
    robots.forEach((r, i) => ends.push(streams.subscribe(`reference:world:trail:${r.name}`, 'append', (block) => (this.trails[i]?.add(block), redraw()))));
    return () => {
      ends.forEach((end) => end());
      this.poses = [];
      this.trails = [];
      redraw();
    };
  }

  draw(c: CanvasRenderingContext2D, t: Placed & { s: number }, robots: RobotInfo[], colour: (i: number) => string, trails: boolean): void {
    robots.forEach((r, i) => {
      if (trails) this.trails[i]?.draw(c, t, colour(i), [5, 4]);
      const x = this.poses[i * 5], y = this.poses[i * 5 + 1], yaw = this.poses[i * 5 + 3] ?? 0;
      if (x === undefined || y === undefined) return;
      const radius = Math.max(6, r.radius * t.s);
      c.save();
      c.translate(t.px(x), t.py(y));
      c.rotate(-yaw);
      c.globalAlpha = 0.7;
      c.strokeStyle = colour(i);
      c.lineWidth = 2;
      c.setLineDash([3, 3]);
      c.beginPath();
      c.arc(0, 0, radius, 0, 7);
      c.moveTo(0, 0);
      c.lineTo(radius, 0);
      c.stroke();
      c.restore();
    });
  }
}
