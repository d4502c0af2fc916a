// Light or dark: the system's choice, unless the user chose.
import { MediaQuery } from 'svelte/reactivity';

export type Choice = 'auto' | 'light' | 'dark';

const systemDark = new MediaQuery('prefers-color-scheme: dark'), kept = localStorage.getItem('theme');

class Theme {
  choice = $state<Choice>(kept === 'light' || kept === 'dark' ? kept : 'auto');
  dark = $derived(this.choice === 'auto' ? systemDark.current : this.choice === 'dark');

  choose(choice: Choice): void {
    this.choice = choice;
    localStorage.setItem('theme', choice);
  }
  toggle(): void {
    this.choose(this.dark ? 'light' : 'dark');
  }
}

export const theme = new Theme();
