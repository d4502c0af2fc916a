// What one works with stays below the mouse, while what is above it comes, goes or grows.

/**
 * For the content of a box that scrolls: what was pressed or focused last, and is in sight, keeps its place. What has `data-steady` keeps
 * it as a whole.
 */
export function steady(content: HTMLElement) {
  const box = content.parentElement!;
  let held: Element | null = null, at = 0;
  const note = () => (at = held?.getBoundingClientRect().top ?? 0);
  function hold(e: Event) {
    held = (e.target as Element).closest('[data-steady]') ?? (e.target as Element);
    note();
  }
  const sizes = new ResizeObserver(() => {
    if (!held?.isConnected) return;
    const now = held.getBoundingClientRect(), seen = box.getBoundingClientRect();
    if (at < seen.bottom && at + now.height > seen.top) box.scrollTop += now.top - at;
    note();
  });
  sizes.observe(content);
  content.addEventListener('pointerdown', hold);
  content.addEventListener('focusin', hold);
  box.addEventListener('scroll', note);
  return { destroy: () => sizes.disconnect() };
}
