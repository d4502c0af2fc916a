// The question before changes would be lost, and its answer.
import { tick } from 'svelte';

interface Question {
  title: string;
  text: string;
  /** The text of the button that continues without saving. */
  verb: string;
  /** Saves first, and resolves with whether all is saved; without it there is nothing to save. */
  save?(): Promise<boolean>;
}

class Leaving {
  question = $state.raw<Question | null>(null);
  private answered: (proceed: boolean) => void = () => {};

  /** Resolves with whether to continue. */
  ask(question: Question): Promise<boolean> {
    this.answered(false);
    this.question = question;
    return new Promise((answered) => (this.answered = answered));
  }
  answer(proceed: boolean): void {
    this.question = null;
    this.answered(proceed);
  }
  async act(): Promise<void> {
    const save = this.question?.save;
    this.question = null;
    await tick(); // a dialog that asks where to save takes the focus that this one gives back
    this.answered(save ? await save() : true);
  }
}

export const leaving = new Leaving();
