// Toggles, texts, lists and colours.

import { h } from "../ui/dom";
import { fromHex, splitStrength, toHex } from "./colour";
import type { Control, ControlEvents } from "./control";
import { numberInput } from "./number_input";
import type { EnumField, FieldNode, TextField, ToggleField, VectorField } from "./tree";

export function toggleControl(field: ToggleField, events: ControlEvents): Control {
  const box = h("input", { type: "checkbox", role: "switch", class: "switch", "aria-label": field.label });
  box.addEventListener("change", () => events.changed(box.checked, "done"));
  return {
    value: box,
    show: (node: FieldNode) => {
      if (node.kind === "toggle") box.checked = node.value;
    },
    isHeld: () => false,
  };
}

export function textControl(field: TextField, events: ControlEvents): Control {
  const input = h("input", { type: "text", class: "text", autocomplete: "off", "aria-label": field.label });
  let shown = field.value;
  input.addEventListener("change", () => events.changed(input.value, "done"));
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    input.value = shown;
    input.blur();
  });
  return {
    value: h("span"),
    below: input,
    show: (node: FieldNode) => {
      if (node.kind !== "text") return;
      shown = node.value;
      input.value = node.value;
    },
    isHeld: () => document.activeElement === input && input.value !== shown,
  };
}

export function enumControl(field: EnumField, events: ControlEvents): Control {
  const select = h("select", { "aria-label": field.label });
  for (const { value, label } of field.options) select.append(h("option", { value }, label));
  const isNumber = typeof field.value === "number";
  select.addEventListener("change", () => events.changed(isNumber ? Number(select.value) : select.value, "done"));
  return {
    value: select,
    show: (node: FieldNode) => {
      if (node.kind === "enum") select.value = String(node.value);
    },
    isHeld: () => false,
  };
}

/** A swatch that opens the browser's picker and, for colours that may exceed 1, the factor by which they do. */
export function colourControl(field: VectorField, events: ControlEvents): Control {
  const swatch = h("input", { type: "color", "aria-label": field.label });
  let strength = 1;
  const colour = () => {
    const { x, y, z } = fromHex(swatch.value);
    return { x: x * strength, y: y * strength, z: z * strength };
  };
  swatch.addEventListener("input", () => events.changed(colour(), "moving"));
  swatch.addEventListener("change", () => events.changed(colour(), "done"));
  const factor = numberInput({
    label: `${field.label}, brightness`,
    integer: false,
    onNumber: (value) => {
      strength = value;
      events.changed(colour(), "done");
    },
    onUnreadable: (complaint) => events.unreadable(complaint),
  });
  const exceeds = (field.annotation.max ?? 1) > 1;
  return {
    value: h("span", { class: "colour" }, ...(exceeds ? ["×", factor.element] : []), swatch),
    show: (node: FieldNode) => {
      if (node.kind !== "colour") return;
      const split = splitStrength(node.value);
      strength = split.strength;
      factor.show(strength);
      // The picker's own event would take its rounding to bytes for a choice; setting it raises none.
      swatch.value = toHex(split.base);
    },
    isHeld: () => factor.isHeld(),
  };
}
