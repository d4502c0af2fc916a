/** Does what moves things after a click: not below a drag, nor below a second click, which means what was there for the first one. */
export class AfterClick {
  /** How long a second click may take, ms. */
  static readonly pause = 300;
  private wanted = false;
  private held = false;
  private released = -Infinity;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly act: () => void) {}
  /** Says whether it is to be done, as soon as it may. */
  want(wanted: boolean): void {
    this.wanted = wanted;
    clearTimeout(this.timer);
    if (!wanted || this.held) return;
    this.timer = setTimeout(() => {
      this.wanted = false;
      this.act();
    }, this.released + AfterClick.pause - performance.now());
  }
  /** The pointer is pressed: what was wanted before is not wanted any more. */
  press(): void {
    this.held = true;
    this.want(false);
  }
  release(): void {
    if (!this.held) return;
    this.held = false;
    this.released = performance.now();
    this.want(this.wanted);
  }
}
