// A line without axes: the shape of the last half minute, and ticks where the simulation was changed.

import { kHistoryMilliseconds, type Sample } from "./history";

const kSvg = "http://www.w3.org/2000/svg";
export const kSparkWidth = 72;
export const kSparkHeight = 18;
const kMargin = 1.5;

export class Sparkline {
  readonly element = document.createElementNS(kSvg, "svg");
  private readonly line = document.createElementNS(kSvg, "path");
  private readonly ticks = document.createElementNS(kSvg, "path");

  constructor() {
    this.element.setAttribute("viewBox", `0 0 ${kSparkWidth} ${kSparkHeight}`);
    this.element.setAttribute("preserveAspectRatio", "none");
    this.element.setAttribute("class", "spark");
    this.element.setAttribute("aria-hidden", "true");
    this.line.setAttribute("class", "spark-line");
    this.ticks.setAttribute("class", "spark-ticks");
    this.element.append(this.ticks, this.line);
  }

  draw(samples: readonly Sample[], marks: readonly number[]): void {
    this.line.setAttribute("d", sparkPath(samples));
    const end = samples.at(-1)?.at;
    const shown = end === undefined ? [] : marks.filter((at) => at > end - kHistoryMilliseconds && at <= end);
    this.ticks.setAttribute("d", shown.map((at) => `M${acrossAt(at, end!)} 0v${kSparkHeight}`).join(""));
  }
}

/** The newest sample stands at the right edge; the range of values fills the height. */
export function sparkPath(samples: readonly Sample[]): string {
  const end = samples.at(-1)?.at;
  if (end === undefined || samples.length < 2) return "";
  const values = samples.map(({ value }) => value);
  const least = Math.min(...values);
  const span = Math.max(...values) - least;
  const room = kSparkHeight - 2 * kMargin;
  const down = (value: number) => kMargin + room * (span > 0 ? 1 - (value - least) / span : 0.5);
  return samples
    .map(({ at, value }, index) => `${index === 0 ? "M" : "L"}${acrossAt(at, end)} ${down(value).toFixed(1)}`)
    .join("");
}

function acrossAt(at: number, end: number): string {
  return (kSparkWidth * (1 - (end - at) / kHistoryMilliseconds)).toFixed(1);
}
