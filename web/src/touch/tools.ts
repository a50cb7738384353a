// What a finger or the left button does on the picture: one tool of a few, by mouse, finger or the keys 1 to 5.

import { Interact_Action as Action } from "../gen/sluice/v1/session_pb";
import { h, uniqueId } from "../ui/dom";
import { icon } from "../ui/icons";

export type Tool = "turn" | "push" | "pull" | "add" | "pick";
/** A tool that touches the fluid. */
export type TouchTool = "push" | "pull" | "add";

const kTools: readonly { readonly tool: Tool; readonly label: string }[] = [
  { tool: "turn", label: "Turn the camera" },
  { tool: "push", label: "Push the fluid" },
  { tool: "pull", label: "Pull the fluid" },
  { tool: "add", label: "Add fluid" },
  { tool: "pick", label: "Read the fluid under the cursor" },
];

export const kActions: Readonly<Record<TouchTool, Action>> = {
  push: Action.PUSH,
  pull: Action.PULL,
  add: Action.ADD,
};

export function touches(tool: Tool): tool is TouchTool {
  return tool in kActions;
}

export class ToolSwitch {
  private chosen: Tool = "turn";
  private reasons: Partial<Record<Tool, string>> = {};
  private readonly inputs = new Map<Tool, { input: HTMLInputElement; label: HTMLElement }>();
  private readonly fluids = h("select", { "aria-label": "Fluid to add", class: "fluid-choice", hidden: true });

  constructor(
    container: HTMLElement,
    private readonly onChange: (tool: Tool) => void,
  ) {
    const group = uniqueId("tools");
    kTools.forEach(({ tool, label }, at) => {
      const input = h("input", { type: "radio", name: group, class: "only-read", "aria-label": label });
      const button = h("label", { class: "tool", "data-tool": tool }, input, icon(tool));
      input.addEventListener("change", () => this.choose(tool));
      this.inputs.set(tool, { input, label: button });
      button.title = `${label} (${at + 1})`;
      container.append(button);
    });
    container.append(this.fluids);
    document.addEventListener("keydown", (event) => this.key(event));
    this.show();
  }

  /** The chosen tool, or the camera where it is not possible now. */
  get current(): Tool {
    return this.reasons[this.chosen] === undefined ? this.chosen : "turn";
  }

  /** Which of the scene's fluids is added. */
  get fluid(): number {
    return Math.max(0, this.fluids.selectedIndex);
  }

  /** Tools that are not possible now, and why. */
  forbid(reasons: Partial<Record<Tool, string>>): void {
    const before = this.current;
    this.reasons = reasons;
    this.show();
    if (this.current !== before) this.onChange(this.current);
  }

  setFluids(names: readonly string[]): void {
    const { selectedIndex } = this.fluids;
    this.fluids.replaceChildren(...names.map((name, at) => h("option", { value: at }, name || `Fluid ${at + 1}`)));
    this.fluids.selectedIndex = Math.min(Math.max(0, selectedIndex), names.length - 1);
    this.show();
  }

  private choose(tool: Tool): void {
    if (this.reasons[tool] !== undefined) return;
    this.chosen = tool;
    this.show();
    this.onChange(tool);
  }

  private show(): void {
    kTools.forEach(({ tool, label }, at) => {
      const { input, label: button } = this.inputs.get(tool)!;
      const reason = this.reasons[tool];
      input.checked = tool === this.current;
      input.disabled = reason !== undefined;
      button.title = reason === undefined ? `${label} (${at + 1})` : `${label}: ${reason}`;
    });
    this.fluids.hidden = this.current !== "add" || this.fluids.childElementCount < 2;
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const { target } = event;
    if (target instanceof HTMLElement && target.matches("select, textarea, input:not([type=range], [type=radio], [type=checkbox])")) return;
    const tool = kTools[Number(event.key) - 1]?.tool;
    if (tool) this.choose(tool);
  }
}
