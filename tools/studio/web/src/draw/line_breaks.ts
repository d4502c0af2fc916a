/** The parts of a name after which a line may break: "initialization_" and "probability"; "vm" and "Max". */
export const nameParts = (name: string): string[] => name.match(/[^_]*_+|[^_]+/g)?.flatMap((part) => part.match(/[A-Z]*[^A-Z]+|[A-Z]+/g) ?? [part]) ?? [];
