// Where the time from an input to its picture goes, as one bar of four parts.

import { h, setText } from "../ui/dom";
import { milliseconds } from "./format";
import type { DelayParts } from "./meters";

const kParts: readonly { readonly part: keyof DelayParts; readonly label: string }[] = [
  { part: "gather", label: "until sent (here)" },
  { part: "server", label: "server" },
  { part: "travel", label: "network and decoding" },
  { part: "draw", label: "until drawn (here)" },
];

export class DelaySplit {
  readonly element: HTMLElement;
  private readonly empty = h("p", { class: "reason" }, "Move the camera to measure it.");
  private readonly bar = h("div", { class: "split-bar" });
  private readonly list = h("dl", { class: "split-list" });
  private readonly figures: HTMLElement[] = [];

  constructor() {
    for (const { part, label } of kParts) {
      this.bar.append(h("span", { "data-part": part }));
      const figure = h("dd");
      this.figures.push(figure);
      this.list.append(h("dt", { "data-part": part }, label), figure);
    }
    const total = h("dd");
    this.figures.push(total);
    this.list.append(h("dt", { class: "total" }, "input to picture"), total);
    this.element = h("div", { class: "split" }, this.empty, this.bar, this.list);
    this.show(undefined);
  }

  show(parts: DelayParts | undefined): void {
    this.empty.hidden = parts !== undefined;
    this.bar.hidden = this.list.hidden = parts === undefined;
    if (!parts) return;
    const times = kParts.map(({ part }) => parts[part]);
    const total = times.reduce((sum, time) => sum + time, 0);
    times.forEach((time, at) => (this.bar.children[at] as HTMLElement).style.setProperty("flex-grow", time.toFixed(2)));
    [...times, total].forEach((time, at) => setText(this.figures[at]!, milliseconds(time)));
  }
}
