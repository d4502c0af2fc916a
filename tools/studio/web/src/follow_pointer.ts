/** Follows a pointer that was pressed on an element: `move` gets where it goes, and `end` where it was released, or null when the browser took it away. */
export function followPointer({ pointerId }: PointerEvent, target: Element, move: (e: PointerEvent) => unknown, end: (e: PointerEvent | null) => unknown = () => {}): void {
  const ended = new AbortController();
  const on = (type: string, act: (e: PointerEvent) => unknown) => target.addEventListener(type, act as EventListener, { signal: ended.signal });
  const stop = (at: PointerEvent | null) => (ended.abort(), end(at));
  target.setPointerCapture(pointerId);
  on('pointermove', move);
  on('pointerup', stop);
  on('pointercancel', () => stop(null));
}
