// Made by tutorial/plugin.ts from docs/tutorial.
declare module 'virtual:tutorial' {
  export const pages: { id: string; title: string; html: string; setups: import('./setup').Setup[] }[];
}
