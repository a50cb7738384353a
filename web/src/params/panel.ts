// The parameters of the scene as people see and move them. Built from the tree; rebuilt only when its shape changes.

import type { Scene } from "../gen/sluice/v1/scene_pb";
import { h, uniqueId } from "../ui/dom";
import { explain } from "../ui/tooltip";
import { FieldRow } from "./field_row";
import { isWithin } from "./path";
import { type ChoiceNode, fieldsIn, type GroupNode, type Node, parameterTree, shapeOf } from "./tree";
import type { Edit } from "./update";

/** Groups that are open when the page comes up: the look, and what stands directly in it. */
const kOpenAtFirst = /^look(\.\w+)?$/;

export interface PanelHost {
  submit(edit: Edit): void;
  /** An edit of this field is under way, so that what the server last said about it is out of date. */
  isBusy(path: string): boolean;
  /** Takes a complaint for which the panel has no place. */
  report(message: string): void;
}

export class ParameterPanel {
  private readonly rows = new Map<string, FieldRow>();
  private readonly choices = new Map<string, HTMLElement>();
  private readonly openGroups = new Map<string, boolean>();
  private tree: readonly GroupNode[] = [];
  private shape = "";
  /** Fields whose newest server value was not shown because a person was at them. */
  private readonly missed = new Set<string>();

  constructor(
    private readonly container: HTMLElement,
    private readonly host: PanelHost,
  ) {
    // Whoever lets go of a control sees what the server has said meanwhile. A release comes before its own edit.
    for (const type of ["focusout", "pointerup"]) {
      container.addEventListener(type, () => setTimeout(() => this.catchUp()));
    }
  }

  setScene(scene: Scene): void {
    this.tree = parameterTree(scene);
    const shape = shapeOf(this.tree);
    if (shape !== this.shape) {
      this.shape = shape;
      this.rebuild();
      return;
    }
    for (const field of fieldsIn(this.tree)) {
      const row = this.rows.get(field.path);
      if (row?.isHeld() || this.host.isBusy(field.path)) this.missed.add(field.path);
      else row?.show(field);
    }
  }

  /** The last edit of a field was answered. A refused one goes back to the server's value, and says why. */
  settled(path: string, error: string | undefined): void {
    const row = this.rows.get(path);
    if (error === undefined) {
      this.catchUp();
      return;
    }
    const field = fieldsIn(this.tree).find((candidate) => candidate.path === path);
    if (row && field) row.show(field);
    else this.rebuild();
    this.missed.delete(path);
    if (!this.complain(path, error)) this.host.report(`${path}: ${error}`);
  }

  /** Shows server values that had to wait, where nobody is at the control any more. */
  private catchUp(): void {
    if (this.missed.size === 0) return;
    for (const field of fieldsIn(this.tree)) {
      const row = this.rows.get(field.path);
      if (!row || !this.missed.has(field.path) || row.isHeld() || this.host.isBusy(field.path)) continue;
      this.missed.delete(field.path);
      row.show(field);
    }
  }

  /** Shows the server's word at the field that it names, or at the nearest one around it. False where there is none. */
  complain(path: string, message: string): boolean {
    const named = [...this.rows.keys(), ...this.choices.keys()]
      .filter((candidate) => isWithin(path, candidate))
      .sort((a, b) => b.length - a.length)[0];
    if (named === undefined) return false;
    const row = this.rows.get(named);
    row?.complain(message);
    const choice = this.choices.get(named);
    if (choice) {
      choice.textContent = message;
      choice.hidden = false;
    }
    const element = row?.element ?? choice!;
    for (let group = element.closest("details"); group; group = group.parentElement?.closest("details") ?? null) {
      group.open = true;
    }
    element.scrollIntoView({ block: "nearest" });
    return true;
  }

  private rebuild(): void {
    const focused = this.focusedField();
    this.rows.clear();
    this.choices.clear();
    this.missed.clear();
    this.container.replaceChildren(...this.tree.map((group) => this.groupElement(group, 1)));
    this.focusField(focused);
  }

  private elements(nodes: readonly Node[], level: number): HTMLElement[] {
    return nodes.map((node) => {
      if (node.kind === "group") return this.groupElement(node, level);
      if (node.kind === "choice") return this.choiceElement(node, level);
      const row = new FieldRow(node, (edit) => this.host.submit(edit));
      this.rows.set(node.path, row);
      return row.element;
    });
  }

  private groupElement(node: GroupNode, level: number): HTMLElement {
    const summary = h("summary", {}, h("span", {}, node.label));
    const open = this.openGroups.get(node.path) ?? kOpenAtFirst.test(node.path);
    const details = h("details", { class: `group level-${Math.min(level, 3)}`, "data-path": node.path, open }, summary);
    details.addEventListener("toggle", () => this.openGroups.set(node.path, details.open));
    if (node.on !== undefined) {
      const box = h("input", { type: "checkbox", role: "switch", class: "switch", "aria-label": node.label });
      box.checked = node.on;
      box.addEventListener("change", () =>
        this.host.submit({ path: node.path, message: box.checked ? "present" : "absent" }),
      );
      box.addEventListener("click", (event) => event.stopPropagation());
      summary.append(box);
    }
    explain(summary, () => ({ text: node.doc }));
    details.append(h("div", { class: "group-body" }, ...this.elements(node.children, level + 1)));
    return details;
  }

  private choiceElement(node: ChoiceNode, level: number): HTMLElement {
    const chosen = node.options.find((option) => option.path === node.chosen);
    const label = h("span", { class: "label" }, node.label);
    const others = node.options.filter((option) => option.available && option !== chosen);
    const value = others.length > 0 ? this.choiceSelect(node) : h("span", { class: "fixed" }, chosen?.label ?? "none");
    const complaint = h("p", { class: "complaint", role: "alert", id: uniqueId("complaint"), hidden: true });
    for (const option of node.options) this.choices.set(option.path, complaint);
    const row = h("div", { class: "row choice", "data-path": node.path }, h("div", { class: "line" }, label, value), complaint);
    explain(row, () => ({ text: node.doc, detail: chosen?.doc ?? "" }), label);
    return h("div", { class: "chosen" }, row, ...this.elements(node.children, level));
  }

  private choiceSelect(node: ChoiceNode): HTMLSelectElement {
    const select = h("select", { "aria-label": node.label });
    for (const { path, label, doc, available } of node.options) {
      const disabled = !available && path !== node.chosen;
      select.append(h("option", { value: path, title: doc, disabled, selected: path === node.chosen }, label));
    }
    select.addEventListener("change", () => this.host.submit({ path: select.value, message: "present" }));
    return select;
  }

  /** Which control has the focus, as the row's path and its place among the row's controls. */
  private focusedField(): { path: string; at: number } | undefined {
    const active = document.activeElement;
    const row = active?.closest<HTMLElement>("[data-path]");
    if (!active || !row || !this.container.contains(row)) return undefined;
    return { path: row.dataset["path"]!, at: [...row.querySelectorAll("input, select, button")].indexOf(active) };
  }

  private focusField(focused: { path: string; at: number } | undefined): void {
    if (!focused) return;
    const row = this.container.querySelector(`[data-path="${CSS.escape(focused.path)}"]`);
    const control = row?.querySelectorAll<HTMLElement>("input, select, button")[focused.at];
    control?.focus({ preventScroll: true });
  }
}
