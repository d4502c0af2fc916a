// The buttons of values that one tries: they act once their exercise is set up, and the one with the value in force is pressed.
import { request } from '../studio';

/** Of the active set-up below `body`; others may be about another system. */
export async function showChoices(body: HTMLElement): Promise<void> {
  for (const button of body.querySelectorAll<HTMLButtonElement>('[data-set]')) {
    button.disabled = !button.closest('.setup.active');
    if (button.disabled) button.removeAttribute('aria-pressed');
  }
  for (const choices of body.querySelectorAll<HTMLElement>('.setup.active .choices')) {
    const assignment = choices.getAttribute('aria-label')!;
    const item = assignment.slice(0, assignment.lastIndexOf('.'));
    const value = await request('parameters', { item }).then(
      (r) => r.parameters.find((p) => p.assignment === assignment)?.value,
      () => undefined, // the system that is open is another one
    );
    if (!choices.closest('.setup.active')) continue; // another one was set up meanwhile
    for (const button of choices.querySelectorAll<HTMLElement>('[data-set]')) {
      const own = button.dataset.set!.slice(assignment.length + 1);
      const inForce = value !== undefined && (String(value) === own || (own !== '' && Number(value) === Number(own)));
      button.setAttribute('aria-pressed', String(inForce));
    }
  }
}
