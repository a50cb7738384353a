// Which of the server's scenes runs.

import type { SceneEntry } from "../gen/sluice/v1/session_pb";
import { h } from "./dom";

/** Stands for a scene that is not among the shipped ones. */
const kOther = "";

export class SceneMenu {
  private entries: readonly SceneEntry[] = [];
  private current = kOther;
  private reason: string | undefined;

  constructor(
    private readonly select: HTMLSelectElement,
    onChoose: (name: string) => void,
  ) {
    select.addEventListener("change", () => {
      const { value } = select;
      if (value !== kOther && value !== this.current) onChoose(value);
    });
  }

  setEntries(entries: readonly SceneEntry[]): void {
    this.entries = entries;
  }

  /** The scene that runs; `name` is empty for one that did not come with the server. */
  show(name: string, title: string): void {
    this.current = name;
    const options = this.entries.map((entry) => h("option", { value: entry.name }, entry.title || entry.name));
    if (!this.entries.some((entry) => entry.name === name)) {
      options.unshift(h("option", { value: name }, title || name || "Own scene"));
    }
    this.select.replaceChildren(...options);
    this.revert();
  }

  /** With the reason why the scene cannot be changed, or without. */
  forbid(reason: string | undefined): void {
    this.select.disabled = reason !== undefined;
    this.reason = reason;
    this.revert();
  }

  /** A choice was refused. */
  revert(): void {
    this.select.value = this.current;
    this.select.title = this.reason ?? this.select.selectedOptions[0]?.text ?? "";
  }
}
