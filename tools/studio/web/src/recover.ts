// How the user resumes a session after the server has died.
const quoted = (path: string) => (/^[\w./-]+$/.test(path) ? path : `'${path.replace(/'/g, `'\\''`)}'`);

/** The shell command that resumes the session of a system. */
export const recoverCommand = (system: string, world: string): string => `forage studio ${system ? quoted(system) : 'FILE'}${world ? ` --world ${quoted(world)}` : ''} --recover`;
