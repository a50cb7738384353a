// A number: a field to type into and, where the range suits one, a slider.

import { h } from "../ui/dom";
import type { Control, ControlEvents } from "./control";
import { formatNumber } from "./control";
import { numberInput } from "./number_input";
import { type SliderScale, sliderScale } from "./slider_scale";
import type { FieldNode, NumberField } from "./tree";

export function numberControl(field: NumberField, events: ControlEvents): Control {
  const toServer = (value: number) => (field.wide ? BigInt(value) : value);
  const input = numberInput({
    label: field.label,
    integer: field.integer,
    onNumber: (value) => {
      slider?.show(value);
      events.changed(toServer(value), "done");
    },
    onUnreadable: (complaint) => events.unreadable(complaint),
  });
  const scale = sliderScale(field.annotation, field.standard, field.integer);
  const slider = scale && sliderOf(field, scale, (value, phase) => {
    input.show(value);
    events.changed(toServer(value), phase);
  });
  return {
    value: input.element,
    ...(slider ? { below: slider.element } : {}),
    show: (node: FieldNode) => {
      if (node.kind !== "number") return;
      input.show(node.value);
      slider?.show(node.value);
    },
    isHeld: () => input.isHeld() || (slider?.isHeld() ?? false),
  };
}

interface Slider {
  readonly element: HTMLInputElement;
  show(value: number): void;
  isHeld(): boolean;
}

function sliderOf(
  field: NumberField,
  scale: SliderScale,
  onValue: (value: number, phase: "moving" | "done") => void,
): Slider {
  const element = h("input", { type: "range", min: 0, max: 1, step: scale.step, "aria-label": field.label });
  let held = false;

  const paint = (value: number) => {
    element.style.setProperty("--way", String(element.valueAsNumber));
    element.setAttribute("aria-valuetext", `${formatNumber(value)} ${field.annotation.unit}`.trim());
  };
  const show = (value: number) => {
    element.valueAsNumber = scale.toWay(value);
    paint(value);
  };
  // A notch marks the default.
  if (field.standard !== undefined) element.style.setProperty("--standard", String(scale.toWay(field.standard)));

  element.addEventListener("pointerdown", () => {
    held = true;
  });
  element.addEventListener("pointerup", () => {
    held = false;
  });
  element.addEventListener("pointercancel", () => {
    held = false;
  });
  element.addEventListener("input", () => {
    const value = scale.toValue(element.valueAsNumber);
    paint(value);
    onValue(value, "moving");
  });
  element.addEventListener("change", () => {
    held = false;
    onValue(scale.toValue(element.valueAsNumber), "done");
  });
  return { element, show, isHeld: () => held };
}
