// Whether the dialog about the program is open.
class About { open = $state(false) }
export const about = new About();
