// Rows of the panel that belong to this viewer alone: a label, a control, and a word about it.

import type { SliderScale } from "../params/slider_scale";
import { h, setText } from "./dom";
import { explain } from "./tooltip";

export interface Row<T> {
  readonly element: HTMLElement;
  show(value: T): void;
}

export interface Choice {
  readonly value: string;
  readonly label: string;
  readonly doc: string;
  readonly disabled?: boolean;
}

export interface ChoiceRow extends Row<string> {
  setChoices(choices: readonly Choice[]): void;
}

export function choiceRow(label: string, onChoose: (value: string) => void): ChoiceRow {
  const select = h("select", { "aria-label": label });
  let docs = new Map<string, string>();
  select.addEventListener("change", () => onChoose(select.value));
  const name = h("span", { class: "label" }, label);
  const element = h("div", { class: "row choice" }, h("div", { class: "line" }, name, select));
  explain(element, () => ({ text: docs.get(select.value) ?? "" }), name);
  return {
    element,
    show: (value) => {
      select.value = value;
    },
    setChoices: (choices) => {
      const { value } = select;
      docs = new Map(choices.map((choice) => [choice.value, choice.doc]));
      select.replaceChildren(
        ...choices.map((choice) =>
          h("option", { value: choice.value, title: choice.doc, disabled: choice.disabled }, choice.label),
        ),
      );
      if (docs.has(value)) select.value = value;
    },
  };
}

export function sliderRow(
  label: string,
  doc: string,
  scale: SliderScale,
  inWords: (value: number) => string,
  onValue: (value: number) => void,
): Row<number> {
  const slider = h("input", { type: "range", min: 0, max: 1, step: scale.step, "aria-label": label });
  const figure = h("output", { class: "figure" });
  const name = h("span", { class: "label" }, label);
  const element = h("div", { class: "row" }, h("div", { class: "line" }, name, figure), slider);
  const paint = (value: number) => {
    slider.style.setProperty("--way", String(slider.valueAsNumber));
    slider.setAttribute("aria-valuetext", inWords(value));
    setText(figure, inWords(value));
  };
  slider.addEventListener("input", () => paint(scale.toValue(slider.valueAsNumber)));
  // Each value makes the server's encoder start anew; the ones on the way are of no use.
  slider.addEventListener("change", () => onValue(scale.toValue(slider.valueAsNumber)));
  explain(element, () => ({ text: doc }), name);
  return {
    element,
    show: (value) => {
      slider.valueAsNumber = scale.toWay(value);
      paint(value);
    },
  };
}

export function switchRow(label: string, doc: string, onSwitch: (on: boolean) => void): Row<boolean> {
  const box = h("input", { type: "checkbox", role: "switch", class: "switch", "aria-label": label });
  const name = h("span", { class: "label" }, label);
  const element = h("div", { class: "row" }, h("div", { class: "line" }, name, box));
  box.addEventListener("change", () => onSwitch(box.checked));
  explain(element, () => ({ text: doc }), name);
  return {
    element,
    show: (on) => {
      box.checked = on;
    },
  };
}
