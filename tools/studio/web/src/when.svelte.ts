/** Acts at first, and again when one of these values changes. What `act` reads counts, too. */
export function when(values: () => unknown, act: () => unknown): void {
  $effect(() => {
    values();
    act();
  });
}
