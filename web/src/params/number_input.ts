// A field to type a number into: Enter takes it, Escape puts it back, the arrows step.

import { h } from "../ui/dom";
import { formatNumber, nudgeOf, parseNumber } from "./control";

export interface NumberInput {
  readonly element: HTMLInputElement;
  show(value: number): void;
  isHeld(): boolean;
}

export interface NumberInputOptions {
  readonly label: string;
  readonly integer: boolean;
  onNumber(value: number): void;
  onUnreadable(complaint: string | undefined): void;
}

export function numberInput({ label, integer, onNumber, onUnreadable }: NumberInputOptions): NumberInput {
  const element = h("input", {
    type: "text",
    inputmode: integer ? "numeric" : "decimal",
    autocomplete: "off",
    spellcheck: "false",
    class: "number",
    "aria-label": label,
  });
  let shown = 0;
  let edited = false;

  const show = (value: number) => {
    shown = value;
    edited = false;
    element.value = formatNumber(value);
  };
  const take = () => {
    if (!edited) return;
    const value = parseNumber(element.value);
    if (value === undefined || (integer && !Number.isInteger(value))) {
      onUnreadable(integer ? "Not a whole number" : "Not a number");
      return;
    }
    edited = false;
    onUnreadable(undefined);
    onNumber(value);
  };

  element.addEventListener("input", () => {
    edited = true;
  });
  element.addEventListener("focus", () => element.select());
  element.addEventListener("change", take);
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter") take();
    if (event.key === "Escape") {
      show(shown);
      onUnreadable(undefined);
      element.blur();
    }
    if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      event.preventDefault();
      const from = parseNumber(element.value) ?? shown;
      const next = from + nudgeOf(from, integer) * (event.key === "ArrowUp" ? 1 : -1);
      show(Number(next.toPrecision(12)));
      onNumber(shown);
    }
  });
  return { element, show, isHeld: () => edited && document.activeElement === element };
}
