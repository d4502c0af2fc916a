/** Which dialog about the program is open; null for none. */
export const dialogs = $state<{ shown: 'about' | 'settings' | null }>({ shown: null });
