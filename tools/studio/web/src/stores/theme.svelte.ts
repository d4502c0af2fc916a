// Light or dark: the system's choice, unless the user chose.
type Choice = 'auto' | 'light' | 'dark';

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
  toggle(): void {
    this.choice = this.dark ? 'light' : 'dark';
    localStorage.setItem('theme', this.choice);
  }
}

export const theme = new Theme();
