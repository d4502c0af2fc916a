import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { AfterClick } from '../../src/parts/after_click';

let done = 0, form: AfterClick;
beforeEach(() => {
  vi.useFakeTimers();
  done = 0;
  form = new AfterClick(() => (done += 1));
});
afterEach(() => void vi.useRealTimers());
const click = () => (form.press(), form.want(true), form.release());

it('acts at once without a pointer', () => {
  form.want(true);
  vi.advanceTimersByTime(0);
  expect(done).toBe(1);
});
it('waits for a second click, which takes the wish of the first one back', () => {
  click();
  vi.advanceTimersByTime(AfterClick.pause - 1);
  expect(done).toBe(0);
  form.press();
  form.release();
  vi.advanceTimersByTime(10 * AfterClick.pause);
  expect(done).toBe(0);
});
it('acts once after a single click', () => {
  click();
  vi.advanceTimersByTime(AfterClick.pause);
  expect(done).toBe(1);
  form.release();
  vi.advanceTimersByTime(10 * AfterClick.pause);
  expect(done).toBe(1);
});
it('waits for the end of a drag', () => {
  form.press();
  form.want(true);
  vi.advanceTimersByTime(10 * AfterClick.pause);
  expect(done).toBe(0);
  form.release();
  vi.advanceTimersByTime(AfterClick.pause);
  expect(done).toBe(1);
});
