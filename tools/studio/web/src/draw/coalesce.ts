/** Returns a function that schedules `act` once, however often it is called before `act` runs. The default runs it after the current messages, so both runs of a comparison are drawn together. */
export function coalesce(act: () => void, schedule: (run: () => void) => unknown = queueMicrotask): () => void {
  let scheduled = false;
  return () => {
    if (scheduled) return;
    scheduled = true;
    schedule(() => {
      scheduled = false;
      act();
    });
  };
}
