import type { Figure } from '../panels/figures';

/** Which dialog about the program is open, and the figure that is being exported; null for none. */
export const dialogs = $state<{ shown: 'about' | 'settings' | 'find' | null; figure: Figure | null }>({ shown: null, figure: null });
