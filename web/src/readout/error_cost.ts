// Error against cost: what a change of tolerance, solver or resolution did to both, side by side.

import type { Stats } from "../gen/sluice/v1/session_pb";
import { h, setText } from "../ui/dom";
import { explain } from "../ui/tooltip";
import { factor, iterations, joules, milliseconds, percent, perSecond } from "./format";
import { History } from "./history";
import { Sparkline } from "./sparkline";

interface Figure {
  readonly label: string;
  readonly doc: string;
  readonly of: (stats: Stats) => number;
  readonly inWords: (value: number | undefined) => string;
}

const kErrors: readonly Figure[] = [
  {
    label: "Density, mean",
    doc: "Compression over the rest density, mean of all particles.",
    of: (stats) => stats.meanDensityError,
    inWords: percent,
  },
  {
    label: "Density, max",
    doc: "Compression of the particle that is compressed most.",
    of: (stats) => stats.maxDensityError,
    inWords: percent,
  },
  {
    label: "Divergence, mean",
    doc: "|∇·v|: how fast the density of a particle changes, over the density; mean of all particles.",
    of: (stats) => stats.meanDivergence,
    inWords: perSecond,
  },
  {
    label: "Divergence, max",
    doc: "|∇·v| of the particle where it is largest.",
    of: (stats) => stats.maxDivergence,
    inWords: perSecond,
  },
  {
    label: "Kinetic energy",
    doc: "Of the fluid.",
    of: (stats) => stats.kineticEnergy,
    inWords: joules,
  },
  {
    label: "Potential energy",
    doc: "Against gravity, from the origin.",
    of: (stats) => stats.potentialEnergy,
    inWords: joules,
  },
  {
    label: "Total energy",
    doc: "Kinetic and potential. It may fall by viscosity and at walls; where it rises and nothing pours in or pushes, the method is at fault.",
    of: (stats) => stats.kineticEnergy + stats.potentialEnergy,
    inWords: joules,
  },
  {
    label: "Momentum drift",
    doc: "Momentum that neither gravity nor walls nor bodies account for, over the sum of m·|v|.",
    of: (stats) => stats.momentumDrift,
    inWords: percent,
  },
];

const kCosts: readonly Figure[] = [
  {
    label: "Time per step",
    doc: "Wall time of one step, all stages.",
    of: (stats) => stats.stages.reduce((sum, stage) => sum + stage.milliseconds, 0),
    inWords: milliseconds,
  },
  {
    label: "Density iterations",
    doc: "Of the solver that keeps the density, in the last step.",
    of: (stats) => stats.densityIterations,
    inWords: iterations,
  },
  {
    label: "Divergence iterations",
    doc: "Of the solver that keeps the velocity free of divergence, in the last step.",
    of: (stats) => stats.divergenceIterations,
    inWords: iterations,
  },
  {
    label: "Step length",
    doc: "Simulated time per step.",
    of: (stats) => 1000 * stats.timeStepSeconds,
    inWords: milliseconds,
  },
  {
    label: "Speed",
    doc: "Simulated seconds per second.",
    of: (stats) => stats.realTimeFactor,
    inWords: factor,
  },
];

/** Changes that follow each other so quickly are one: a slider that is dragged. */
const kOneChangeMilliseconds = 1500;

interface Line {
  readonly figure: Figure;
  readonly history: History;
  readonly spark: Sparkline;
  readonly before: HTMLElement;
  readonly now: HTMLElement;
}

export class ErrorCost {
  readonly element: HTMLElement;
  private readonly lines: Line[] = [];
  private readonly caption = h("p", { class: "change", hidden: true });
  private readonly table: HTMLElement;
  private marks: number[] = [];

  constructor() {
    this.table = h("div", { class: "compare", role: "table", "aria-label": "Error and cost" });
    this.table.append(headOf("Error"), ...kErrors.map((figure) => this.line(figure)));
    this.table.append(headOf("Cost"), ...kCosts.map((figure) => this.line(figure)));
    this.element = h("div", {}, this.caption, this.table);
  }

  add(stats: Stats, now: number): void {
    // A simulation that stands tells the same figures again.
    if (stats.paused && this.lines[0]?.history.last !== undefined) return;
    for (const { figure, history } of this.lines) history.add(now, figure.of(stats));
  }

  /** The simulation's parameters have changed. */
  changed(what: string, now: number): void {
    const joinsLast = now - (this.marks.at(-1) ?? -Infinity) < kOneChangeMilliseconds;
    for (const { history } of this.lines) history.mark(now, joinsLast);
    if (joinsLast) this.marks.pop();
    this.marks = [...this.marks.slice(-9), now];
    setText(this.caption, what);
    this.caption.hidden = false;
    this.table.classList.add("has-change");
  }

  /** Another scene, or a connection that was lost. */
  clear(): void {
    for (const { history } of this.lines) history.clear();
    this.marks = [];
    this.caption.hidden = true;
    this.table.classList.remove("has-change");
  }

  draw(): void {
    if (!this.table.checkVisibility()) return;
    for (const { figure, history, spark, before, now } of this.lines) {
      spark.draw(history.all, this.marks);
      setText(before, history.beforeChange === undefined ? "" : figure.inWords(history.beforeChange));
      // One figure of each step would be a flicker; medians can be compared.
      setText(now, figure.inWords(history.beforeChange === undefined ? history.last : history.sinceChange));
    }
  }

  private line(figure: Figure): HTMLElement {
    const spark = new Sparkline();
    const before = h("span", { class: "before", role: "cell" });
    const now = h("span", { class: "now", role: "cell" });
    this.lines.push({ figure, history: new History(), spark, before, now });
    const label = h("span", { class: "name", role: "rowheader" }, figure.label);
    const row = h("div", { class: "compare-row", role: "row" }, label, before, now);
    label.after(spark.element);
    explain(row, () => ({ text: figure.doc }), row);
    return row;
  }
}

function headOf(title: string): HTMLElement {
  return h(
    "div",
    { class: "compare-row head", role: "row" },
    h("span", { class: "name", role: "columnheader" }, title),
    h("span", { class: "span" }, "30 s"),
    h("span", { class: "before", role: "columnheader" }, "before"),
    h("span", { class: "now", role: "columnheader" }, "now"),
  );
}
