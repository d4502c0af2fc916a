// The buttons of values that one tries: they act once their exercise is set up, and the one with the value in force is pressed.
import type { ParameterValue } from '../protocol/messages';
import { request } from '../studio';

/** The value of a parameter in the run; undefined where another system is open. */
async function valueInForce(assignment: string): Promise<ParameterValue | undefined> {
  const item = assignment.slice(0, assignment.lastIndexOf('.'));
  return request('parameters', { item }).then((r) => r.parameters.find((p) => p.assignment === assignment)?.value, () => undefined);
}
/** Whether a value is the one that a text writes. */
const isValue = (value: ParameterValue | undefined, text: string) => value !== undefined && (String(value) === text || (text !== '' && Number(value) === Number(text)));

/** Whether parameters have the values of "Item.parameter=value" in the run. */
export async function areInForce(assignments: string[]): Promise<boolean> {
  for (const text of assignments) {
    const at = text.indexOf('=');
    if (!isValue(await valueInForce(text.slice(0, at)), text.slice(at + 1))) return false;
  }
  return true;
}

/** Of the active set-up below `body`; others may be about another system. */
export async function showChoices(body: HTMLElement): Promise<void> {
  for (const button of body.querySelectorAll<HTMLButtonElement>('[data-set], [data-check]')) {
    button.disabled = !button.closest('.setup.active');
    if (button.disabled) button.removeAttribute('aria-pressed');
  }
  for (const choices of body.querySelectorAll<HTMLElement>('.setup.active .choices')) {
    const assignment = choices.getAttribute('aria-label')!;
    const value = await valueInForce(assignment);
    if (!choices.closest('.setup.active')) continue; // another one was set up meanwhile
    for (const button of choices.querySelectorAll<HTMLElement>('[data-set]')) {
      button.setAttribute('aria-pressed', String(isValue(value, button.dataset.set!.slice(assignment.length + 1))));
    }
  }
}
