// The world in space, with three.js. Lengths are metres, z is up. Loaded only when the view in space is chosen.
import {
  AmbientLight,
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DirectionalLight,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Object3D,
  PerspectiveCamera,
  PlaneGeometry,
  PointLight,
  Scene,
  SphereGeometry,
  SRGBColorSpace,
  Vector3,
  type Material,
  type Texture,
} from 'three';
import type { Solid, WorldMessage } from '../protocol/messages';
import { placed } from './from_above';
import { robotColour, type LiveWorld } from './live';

const kinds = ['plane', 'box', 'cylinder', 'sphere'];
const rayHeight = 0.06, trailHeight = 0.012;

function geometryOf(kind: string, [x, y, z]: [number, number, number]): BufferGeometry | null {
  if (kind === 'box') return new BoxGeometry(x, y, z);
  if (kind === 'sphere') return new SphereGeometry(x / 2, 24, 16);
  // A cylinder of three.js stands along y.
  return kind === 'cylinder' ? new CylinderGeometry(x / 2, x / 2, z, 32).rotateX(Math.PI / 2) : null;
}

function meshOf(kind: string, size: [number, number, number], colour: Color): Mesh | null {
  const geometry = geometryOf(kind, size);
  return geometry && new Mesh(geometry, new MeshLambertMaterial({ color: colour }));
}

/** Lines whose number changes: pairs of points with a colour and an opacity. */
class Lines {
  private positions: number[] = [];
  private colours: number[] = [];
  readonly object = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));

  constructor() {
    this.object.frustumCulled = false;
  }
  add(a: [number, number, number], b: [number, number, number], colour: Color, opacity: number): void {
    this.positions.push(...a, ...b);
    for (let i = 0; i < 2; i++) this.colours.push(colour.r, colour.g, colour.b, opacity);
  }
  /** Shows what was added since the last call. */
  show(): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(this.colours), 4));
    this.object.geometry.dispose();
    this.object.geometry = geometry;
    this.positions = [];
    this.colours = [];
  }
}

export class WorldScene {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(45, 1, 0.05, 500);
  private readonly robots: { parts: Group; arrow: Mesh; ghost: Mesh }[];
  private readonly objects: Mesh[][];
  private readonly rays = new Lines();
  private readonly trails = new Lines();
  private readonly near = new Color('#78aadc');
  private readonly light = new Color('#ffe25c');

  /** `floor` is the picture of the world's view. */
  constructor(
    private readonly world: WorldMessage,
    floor: Texture,
  ) {
    this.camera.up.set(0, 0, 1);
    this.scene.add(new AmbientLight('#ffffff', 1.6));
    const sun = new DirectionalLight('#ffffff', 1.8);
    sun.position.set(-3, -5, 9);
    this.scene.add(sun, this.rays.object, this.trails.object);
    this.addFloor(floor);
    // What is flat is in the picture of the floor.
    for (const solid of world.solids) if (solid.z + solid.size[2] / 2 >= 0.02) this.addSolid(solid);
    for (const [x, y] of world.targets) this.addTarget(x, y);
    if (world.bounds) this.addBounds(world.bounds);
    this.objects = world.objects.map((o) => o.solids.flatMap((s) => this.addSolid(s)));
    this.robots = world.robots.map((r, i) => {
      const arrow = new Mesh(new ConeGeometry(r.radius * 0.7, r.radius * 1.7, 3).rotateZ(-Math.PI / 2).scale(1, 1, 0.15), new MeshBasicMaterial({ color: robotColour(i) }));
      const parts = new Group();
      const ghost = new Mesh(arrow.geometry, new MeshBasicMaterial({ color: robotColour(i), transparent: true, opacity: 0.4 }));
      this.scene.add(parts, arrow, ghost);
      return { parts, arrow, ghost };
    });
  }

  /** Shows where everything is now, and where the robots of the run to compare with are. Returns the place of the robot that is followed. */
  update(live: LiveWorld, reference: LiveWorld, shown: { rays: boolean; trails: boolean }, followed = 0): Vector3 | null {
    this.world.robots.forEach((r, i) => {
      const { parts, arrow, ghost } = this.robots[i]!, pose = live.pose(i), other = reference.pose(i);
      ghost.visible = other !== null;
      if (other) ghost.position.set(other.x, other.y, r.radius), (ghost.rotation.z = other.yaw);
      parts.visible = arrow.visible = pose !== null;
      if (!pose) return;
      const top = this.placeParts(parts, live.parts.get(r.name));
      arrow.position.set(pose.x, pose.y, top + 0.02);
      arrow.rotation.z = pose.yaw;
    });
    this.world.objects.forEach((o, k) => {
      const pose = live.pose(this.robots.length + k);
      const solids = o.solids.filter((s) => s.kind !== 'plane');
      this.objects[k]!.forEach((mesh, j) => {
        mesh.visible = pose !== null;
        if (!pose) return;
        const [x, y, yaw] = placed(solids[j]!, pose);
        mesh.position.set(x, y, solids[j]!.z);
        mesh.rotation.z = yaw;
      });
    });
    if (shown.rays) { for (const scan of live.scans.values()) this.addRays(scan); }
    this.rays.show();
    this.world.robots.forEach((r, i) => {
      const colour = new Color(robotColour(i));
      for (const [trail, strength] of [[live.trails.get(r.name), 1], [reference.trails.get(r.name), 0.4]] as const)
        if (shown.trails)
          trail?.pieces((first, last, opacity) => {
            for (let j = first; j < last; j++) this.trails.add([trail.x[j]!, trail.y[j]!, trailHeight], [trail.x[j + 1]!, trail.y[j + 1]!, trailHeight], colour, strength * opacity);
          });
    });
    this.trails.show();
    const place = live.pose(followed);
    return place && new Vector3(place.x, place.y, 0);
  }

  dispose(): void {
    this.scene.traverse((o: Object3D) => {
      if (!(o instanceof Mesh || o instanceof LineSegments)) return;
      (o.geometry as BufferGeometry).dispose();
      const material = o.material as Material & { map?: { dispose(): void } };
      material.map?.dispose();
      material.dispose();
    });
  }

  /** Returns its mesh, if its kind has one. */
  private addSolid({ kind, size, color, x, y, z, yaw }: Solid): Mesh[] {
    const mesh = meshOf(kind, size, new Color(color));
    if (!mesh) return [];
    mesh.position.set(x, y, z);
    mesh.rotation.z = yaw;
    this.scene.add(mesh);
    return [mesh];
  }

  private addFloor(map: Texture): void {
    const [x0, y0, x1, y1] = this.world.view;
    map.colorSpace = SRGBColorSpace;
    const floor = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), new MeshBasicMaterial({ map }));
    floor.position.set((x0 + x1) / 2, (y0 + y1) / 2, 0);
    this.scene.add(floor);
  }
  private addTarget(x: number, y: number): void {
    const column = new Mesh(new CylinderGeometry(0.12, 0.12, 0.5, 24, 1, true).rotateX(Math.PI / 2), new MeshBasicMaterial({ color: '#fff3b0', transparent: true, opacity: 0.45, depthWrite: false }));
    const lamp = new Mesh(new SphereGeometry(0.12, 24, 16), new MeshBasicMaterial({ color: '#fffbe0' }));
    const light = new PointLight('#ffe9a0', 3, 4);
    for (const o of [column, lamp, light]) o.position.set(x, y, o === column ? 0.25 : 0.5);
    this.scene.add(column, lamp, light);
  }
  private addBounds([x0, y0, x1, y1]: [number, number, number, number]): void {
    const lines = new Lines(), colour = new Color('#c8cdd2');
    const corners: [number, number, number][] = [[x0, y0, 0.01], [x1, y0, 0.01], [x1, y1, 0.01], [x0, y1, 0.01]];
    corners.forEach((c, i) => lines.add(c, corners[(i + 1) % 4]!, colour, 0.5));
    lines.show();
    this.scene.add(lines.object);
  }
  private addRays(scan: ArrayLike<number>): void {
    for (let i = 0; i + 5 < scan.length; i += 6) {
      const light = scan[i + 4] === 1, activity = scan[i + 5]!;
      if (light && activity < 0.02) continue;
      this.rays.add([scan[i]!, scan[i + 1]!, rayHeight], [scan[i + 2]!, scan[i + 3]!, rayHeight], light ? this.light : this.near, 0.12 + 0.85 * Math.min(1, 2 * activity));
    }
  }
  /** Places the parts of a robot as the server says they lie. Returns the height of the robot. */
  private placeParts(group: Group, rows: ArrayLike<number> | undefined): number {
    if (!rows) return 0.1;
    const count = Math.floor(rows.length / 11);
    if (group.children.length !== count) {
      group.clear();
      for (let i = 0; i < count; i++) {
        const at = 11 * i;
        const colour = new Color().setRGB(rows[at + 8]!, rows[at + 9]!, rows[at + 10]!, SRGBColorSpace);
        group.add(meshOf(kinds[rows[at]!] ?? 'plane', [rows[at + 5]!, rows[at + 6]!, rows[at + 7]!], colour) ?? new Object3D());
      }
    }
    group.children.forEach((mesh, i) => {
      mesh.position.set(rows[11 * i + 1]!, rows[11 * i + 2]!, rows[11 * i + 3]!);
      mesh.rotation.z = rows[11 * i + 4]!;
    });
    return new Box3().setFromObject(group).max.z;
  }
}
