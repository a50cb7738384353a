// A vector: three number fields whose axis letters can be dragged sideways.

import { h } from "../ui/dom";
import type { Vec3 } from "../view/camera";
import type { Control, ControlEvents, Phase } from "./control";
import { nudgeOf } from "./control";
import { numberInput } from "./number_input";
import type { FieldNode, VectorField } from "./tree";

type Axis = keyof Vec3;
const kAxes: readonly Axis[] = ["x", "y", "z"];

export function vectorControl(field: VectorField, events: ControlEvents): Control {
  let current = field.value;
  let scrubbing = false;
  const set = (axis: Axis, component: number, phase: Phase) => {
    current = { ...current, [axis]: component };
    events.changed(current, phase);
  };
  const inputs = kAxes.map((axis) =>
    numberInput({
      label: `${field.label} ${axis}`,
      integer: false,
      onNumber: (component) => set(axis, component, "done"),
      onUnreadable: (complaint) => events.unreadable(complaint),
    }),
  );
  const cells = kAxes.map((axis, at) => {
    const input = inputs[at]!;
    const letter = h("span", { class: "axis", "aria-hidden": true }, axis);
    scrub(letter, {
      start: () => {
        scrubbing = true;
        return current[axis];
      },
      move: (component, phase) => {
        scrubbing = phase === "moving";
        const inside = clampTo(component, field.annotation.min, field.annotation.max);
        input.show(inside);
        set(axis, inside, phase);
      },
    });
    return h("div", { class: "component" }, letter, input.element);
  });
  return {
    value: h("span"),
    below: h("div", { class: "vector" }, ...cells),
    show: (node: FieldNode) => {
      if (node.kind !== "vector") return;
      current = node.value;
      kAxes.forEach((axis, at) => inputs[at]!.show(current[axis]));
    },
    isHeld: () => scrubbing || inputs.some((input) => input.isHeld()),
  };
}

/** A drag has no business outside the range, where the server would refuse every step of it. */
function clampTo(value: number, min = -Infinity, max = Infinity): number {
  return Math.min(max, Math.max(min, value));
}

interface Scrub {
  start(): number;
  move(value: number, phase: Phase): void;
}

/** Dragging `handle` sideways changes a number, one step of its second digit for every two pixels. */
function scrub(handle: HTMLElement, { start, move }: Scrub): void {
  let from: { readonly x: number; readonly value: number; readonly step: number } | undefined;
  let value = 0;
  handle.addEventListener("pointerdown", (event) => {
    value = start();
    from = { x: event.clientX, value, step: nudgeOf(value, false) / 2 };
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  handle.addEventListener("pointermove", (event) => {
    if (!from) return;
    value = Number((from.value + (event.clientX - from.x) * from.step).toPrecision(12));
    move(value, "moving");
  });
  const end = () => {
    if (from) move(value, "done");
    from = undefined;
  };
  handle.addEventListener("pointerup", end);
  handle.addEventListener("pointercancel", end);
}
