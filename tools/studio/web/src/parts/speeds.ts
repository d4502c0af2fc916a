// The usual speeds of a run.
import type { SpeedMode } from '../protocol/messages';

export const speeds: { label: string; mode: SpeedMode; value: number; hint: string }[] = [
  { label: '1×', mode: 'real', value: 1, hint: 'Real time: one second of the world per second' },
  { label: '4×', mode: 'times', value: 4, hint: 'Four times real time' },
  { label: '20×', mode: 'times', value: 20, hint: 'Twenty times real time' },
  { label: 'Max', mode: 'free', value: 0, hint: 'As fast as it goes' },
];
