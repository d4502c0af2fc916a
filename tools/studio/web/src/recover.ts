// How the user goes on after the server has died.
const quoted = (path: string) => (/^[\w./-]+$/.test(path) ? path : `'${path.replace(/'/g, `'\\''`)}'`);

/** The command that goes on with the session of a system, in the shell. */
export const recoverCommand = (system: string, world: string): string => `forage studio ${system ? quoted(system) : 'FILE'}${world ? ` --world ${quoted(world)}` : ''} --recover`;
