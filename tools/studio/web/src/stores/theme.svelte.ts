// Light or dark: the system's choice, unless the user chose.
export type Choice = 'auto' | 'light' | 'dark';

class Theme {
  choice = $state<Choice>('auto');
  private systemDark = $state(false);
  dark = $derived(this.choice === 'auto' ? this.systemDark : this.choice === 'dark');

  start(): void {
    const query = matchMedia('(prefers-color-scheme: dark)');
    this.systemDark = query.matches;
    query.onchange = () => (this.systemDark = query.matches);
    const kept = localStorage.getItem('theme');
    if (kept === 'light' || kept === 'dark') this.choice = kept;
  }
  choose(choice: Choice): void {
    this.choice = choice;
    localStorage.setItem('theme', choice);
  }
  toggle(): void {
    this.choose(this.dark ? 'light' : 'dark');
  }
}

export const theme = new Theme();
