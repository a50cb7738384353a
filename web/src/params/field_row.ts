// One line of the panel: label, marks, control, and what the server said about it.

import { h, uniqueId } from "../ui/dom";
import { icon } from "../ui/icons";
import { explain, type Hint } from "../ui/tooltip";
import { type Control, type ControlEvents, formatNumber, type Value } from "./control";
import { numberControl } from "./number_control";
import { colourControl, enumControl, textControl, toggleControl } from "./simple_controls";
import type { FieldNode } from "./tree";
import type { Edit } from "./update";
import { vectorControl } from "./vector_control";

export class FieldRow {
  readonly element: HTMLElement;
  private readonly control: Control;
  private readonly complaint = h("p", { class: "complaint", role: "alert", id: uniqueId("complaint"), hidden: true });
  private readonly undo = h("button", { type: "button", class: "undo", title: "Back to the default" }, icon("undo", 13));

  constructor(
    private field: FieldNode,
    private readonly submit: (edit: Edit) => void,
  ) {
    this.control = controlFor(field, {
      changed: (value, phase) => {
        // A value that restarts the scene waits until it is final.
        if (phase === "moving" && field.annotation.restart) return;
        this.complain(undefined);
        this.submit({ path: field.path, value });
      },
      unreadable: (complaint) => this.complain(complaint),
    });
    this.undo.setAttribute("aria-label", `Set ${field.label} back to its default`);
    this.undo.addEventListener("click", () => {
      const standard = standardOf(this.field);
      if (standard === undefined) return;
      this.complain(undefined);
      this.submit({ path: field.path, value: standard });
    });
    const label = h("span", { class: "label" }, field.label);
    if (field.annotation.unit) label.append(h("span", { class: "unit" }, field.annotation.unit));
    if (field.annotation.restart) {
      const mark = h("span", { class: "restart", role: "img", "aria-label": "restarts the scene" }, icon("toStart", 11));
      label.append(mark);
    }
    const line = h("div", { class: "line" }, label, this.undo, this.control.value);
    this.element = h("div", { class: "row", "data-path": field.path, role: "group", "aria-label": field.label });
    this.element.append(line, ...(this.control.below ? [this.control.below] : []), this.complaint);
    explain(this.element, () => hintFor(this.field), label);
    this.show(field);
  }

  isHeld(): boolean {
    return this.control.isHeld();
  }

  /** The value that the server holds. */
  show(field: FieldNode): void {
    this.field = field;
    this.control.show(field);
    const standard = standardOf(field);
    this.undo.hidden = standard === undefined || equal(valueOf(field), standard);
  }

  complain(message: string | undefined): void {
    this.complaint.textContent = message ?? "";
    this.complaint.hidden = message === undefined;
    this.element.classList.toggle("refused", message !== undefined);
  }
}

function controlFor(field: FieldNode, events: ControlEvents): Control {
  switch (field.kind) {
    case "number":
      return numberControl(field, events);
    case "toggle":
      return toggleControl(field, events);
    case "text":
      return textControl(field, events);
    case "enum":
      return enumControl(field, events);
    case "vector":
      return vectorControl(field, events);
    case "colour":
      return colourControl(field, events);
  }
}

function valueOf(field: FieldNode): Value {
  return field.kind === "number" && field.wide ? BigInt(field.value) : field.value;
}

function standardOf(field: FieldNode): Value | undefined {
  return field.kind === "number" && field.wide && field.standard !== undefined
    ? BigInt(field.standard)
    : field.standard;
}

function equal(a: Value, b: Value): boolean {
  if (typeof a === "object" && typeof b === "object") return a.x === b.x && a.y === b.y && a.z === b.z;
  return a === b;
}

/** "0 … 50 d² · default 1 · takes effect at once" */
function hintFor(field: FieldNode): Hint {
  const { doc, unit, min, max, restart, allowed } = field.annotation;
  const parts: string[] = [];
  if (allowed.length > 0) parts.push(allowed.map(formatNumber).join(", "));
  else if (min !== undefined && max !== undefined) {
    parts.push(`${formatNumber(min)} … ${formatNumber(max)}${unit ? ` ${unit}` : ""}`);
  }
  const standard = standardOf(field);
  if (standard !== undefined && standard !== "") parts.push(`default ${inWords(standard)}`);
  parts.push(restart ? "restarts the scene" : "takes effect at once");
  return { text: doc, detail: parts.join(" · ") };
}

function inWords(value: Value): string {
  if (typeof value === "number") return formatNumber(value);
  if (typeof value === "boolean") return value ? "on" : "off";
  if (typeof value === "object") return [value.x, value.y, value.z].map(formatNumber).join(", ");
  return String(value);
}
