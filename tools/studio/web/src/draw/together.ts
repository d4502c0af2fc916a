/** Makes a function that acts once for all calls of it in one frame, at the end of that frame, so that both runs of a comparison are drawn at the same moment. */
export function together(act: () => void): () => void {
  let wanted = false;
  return () => {
    if (wanted) return;
    wanted = true;
    queueMicrotask(() => {
      wanted = false;
      act();
    });
  };
}
