// Which dialog about the program is open; null for none.
class Dialogs {
  shown = $state<'about' | 'settings' | null>(null);
}
export const dialogs = new Dialogs();
