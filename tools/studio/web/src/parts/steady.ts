// What one works with stays below the mouse, while what is above it comes, goes or grows.

/**
 * For the content of a box that scrolls: what was pressed or focused last, and is in sight, keeps its place in the box, until the content is
 * `of` another item. What has `data-steady` keeps it as a whole.
 */
export function steady(content: HTMLElement, _of: unknown) {
  const box = content.parentElement!;
  let held: Element | null = null, at = 0;
  /** Of what is held, from the upper edge of the box. */
  const top = () => held!.getBoundingClientRect().top - box.getBoundingClientRect().top;
  const note = () => (at = held ? top() : 0);
  function hold(e: Event) {
    held = (e.target as Element).closest('[data-steady]') ?? (e.target as Element);
    note();
  }
  const sizes = new ResizeObserver(() => {
    if (!held?.isConnected) return;
    if (at < box.clientHeight && at + held.getBoundingClientRect().height > 0) box.scrollTop += top() - at;
    note();
  });
  sizes.observe(content);
  content.addEventListener('pointerdown', hold);
  content.addEventListener('focusin', hold);
  box.addEventListener('scroll', note);
  return {
    update: () => (held = null),
    destroy: () => {
      sizes.disconnect();
      box.removeEventListener('scroll', note);
    },
  };
}
