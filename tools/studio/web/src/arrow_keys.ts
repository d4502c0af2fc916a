/** The step of an arrow key, to the right and downwards; undefined for other keys. */
export const arrowStep = (key: string): [dx: number, dy: number] | undefined => ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<string, [number, number]>)[key];
