// A list of stages with the time each takes, and bars that compare them.

import { h, setText } from "../ui/dom";
import { milliseconds } from "./format";

export interface Stage {
  readonly name: string;
  readonly milliseconds: number;
}

/** Weight of the newest frame: figures that jump with every frame cannot be read. */
const kNewest = 0.15;

export class StageList {
  readonly element = h("div", { class: "stages" });
  private means = new Map<string, number>();
  private shown = "";

  add(stages: readonly Stage[]): void {
    const means = new Map<string, number>();
    for (const { name, milliseconds: time } of stages) {
      const before = this.means.get(name);
      const sum = (means.get(name) ?? 0) + time;
      means.set(name, before === undefined ? sum : before + kNewest * (sum - before));
    }
    this.means = means;
  }

  clear(): void {
    this.means.clear();
  }

  draw(): void {
    if (!this.element.checkVisibility()) return;
    const names = [...this.means.keys()].join("\n");
    if (names !== this.shown) {
      this.shown = names;
      const lines = names === "" ? [] : [...this.means.keys(), "total"];
      this.element.replaceChildren(...lines.map(lineFor));
    }
    if (names === "") return;
    const times = [...this.means.values()];
    const longest = Math.max(...times, 1e-6);
    const total = times.reduce((sum, time) => sum + time, 0);
    [...times, total].forEach((time, at) => {
      const line = this.element.children[at] as HTMLElement;
      line.style.setProperty("--share", at === times.length ? "0" : (time / longest).toFixed(3));
      setText(line.lastElementChild as HTMLElement, milliseconds(time));
    });
  }
}

function lineFor(name: string): HTMLElement {
  return h("div", { class: name === "total" ? "stage total" : "stage" }, h("span", {}, name), h("span", { class: "figure" }));
}
