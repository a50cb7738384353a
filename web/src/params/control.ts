// What every control of the panel has in common.

import type { Vec3 } from "../view/camera";
import type { FieldNode } from "./tree";

export type Value = number | bigint | boolean | string | Vec3;

/** "moving" while a person still drags; "done" once they let go or typed a value in full. */
export type Phase = "moving" | "done";

export interface ControlEvents {
  changed(value: Value, phase: Phase): void;
  /** What was typed is no value; undefined takes an earlier complaint back. */
  unreadable(complaint: string | undefined): void;
}

export interface Control {
  /** Stands on the line of the label. */
  readonly value: HTMLElement;
  /** Stands below it. */
  readonly below?: HTMLElement;
  /** Shows the server's value. */
  show(field: FieldNode): void;
  /** A person is at it now: the server's values wait. */
  isHeld(): boolean;
}

/** At most five significant digits; whole numbers in full. With a true minus sign, which parseNumber takes. */
export function formatNumber(value: number): string {
  return String(Number.isInteger(value) ? value : Number(value.toPrecision(5))).replace(/^-/, "−");
}

/** The number a person typed, with a decimal comma too; undefined where it is none. */
export function parseNumber(text: string): number | undefined {
  const plain = text.trim().replace("−", "-").replace(",", ".");
  const value = Number(plain);
  return plain === "" || !Number.isFinite(value) ? undefined : value;
}

/** The step of an arrow key in a number field: one in the second digit of the value. */
export function nudgeOf(value: number, integer: boolean): number {
  if (integer) return 1;
  const size = Math.max(Math.abs(value), 0.01);
  return 10 ** (Math.floor(Math.log10(size)) - 1);
}
