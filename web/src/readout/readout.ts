// How well it runs: frames, delay, the simulation's pace and accuracy, where the time goes, and what is left out.

import { Codec, type Plan, type PlanChanged, type Stats, type Welcome } from "../gen/sluice/v1/session_pb";
import { codecName } from "../picture/codecs";
import type { DrawnFrame } from "../picture/picture";
import { h, setText } from "../ui/dom";
import { remember, remembered } from "../ui/preferences";
import { explain } from "../ui/tooltip";
import { DelaySplit } from "./delay_split";
import { ErrorCost } from "./error_cost";
import { bytesPerSecond, count, factor, milliseconds, percent } from "./format";
import { DelayMeter, Window } from "./meters";
import { type Stage, StageList } from "./stage_list";

const kFigures = {
  rate: ["Frames", "Pictures drawn in the last second. None are sent while nothing changes."],
  delay: ["Delay", "From your input to the first picture that shows it, median over the last second; measured here, on this clock."],
  speed: ["Speed", "Simulated seconds per second."],
  particles: ["Particles", "Particles of the fluid."],
  error: ["Density error", "How far the density is above that at rest: mean and largest over the particles."],
  step: ["Time step", "Length of the last step, and the bound that set it."],
} as const;

type FigureName = keyof typeof kFigures;

const kRedrawMilliseconds = 250;

export class Readout {
  readonly delay = new DelayMeter();
  private readonly rate = new Window();
  private readonly bytes = new Window();
  private readonly figures: Record<FigureName, { value: HTMLElement; note: HTMLElement }>;
  private readonly split = new DelaySplit();
  private readonly errorCost = new ErrorCost();
  private readonly frameStages = new StageList();
  private readonly stepStages = new StageList();
  private readonly leftOut = h("ul", { class: "left-out" });
  private readonly link = h("dl", { class: "link" });
  private stats: Stats | undefined;
  private welcome: Welcome | undefined;
  private roundTrip: number | undefined;
  private lastFrame: DrawnFrame | undefined;

  /** Fills `container`; `brief` gets the one line that stands on the picture while the panel is closed. */
  constructor(
    container: HTMLElement,
    private readonly brief: HTMLElement,
  ) {
    const grid = h("div", { class: "figures" });
    const cell = (name: FigureName) => {
      const [label, doc] = kFigures[name];
      const value = h("span", { class: "value" }, "–");
      const note = h("span", { class: "note" });
      const box = h("div", { class: "cell", "data-figure": name }, h("span", { class: "name" }, label), value, note);
      explain(box, () => ({ text: doc }), box);
      grid.append(box);
      return { value, note };
    };
    this.figures = {
      rate: cell("rate"),
      delay: cell("delay"),
      speed: cell("speed"),
      particles: cell("particles"),
      error: cell("error"),
      step: cell("step"),
    };
    container.append(
      grid,
      section("Delay of an input", this.split.element),
      section("Error and cost", this.errorCost.element),
      section("Time per picture", this.frameStages.element),
      section("Time per step", this.stepStages.element),
      section("Left out", this.leftOut),
      section("Connection", this.link),
    );
    setInterval(() => this.draw(), kRedrawMilliseconds);
  }

  frameDrawn(drawn: DrawnFrame): void {
    const { frame, receivedAt, decodedAt, drawnAt } = drawn;
    this.lastFrame = drawn;
    this.rate.add(drawnAt);
    this.delay.drawn(Number(frame.reflectsSequence), { decodedAt, drawnAt, response: frame.responseMilliseconds });
    const local: Stage[] = [
      { name: "decode (here)", milliseconds: decodedAt - receivedAt },
      { name: "wait for the screen", milliseconds: drawnAt - decodedAt },
    ];
    this.frameStages.add([...frame.stages, ...local]);
  }

  bytesReceived(size: number): void {
    this.bytes.add(performance.now(), size);
  }

  statsReceived(stats: Stats): void {
    this.stats = stats;
    this.errorCost.add(stats, performance.now());
    if (stats.stages.length > 0) this.stepStages.add(stats.stages);
    else this.stepStages.clear();
  }

  planReceived(plan: PlanChanged): void {
    const entries = [...leftOutOf(plan.frame, "picture"), ...leftOutOf(plan.steps, "step")];
    const none = h("li", {}, h("span", { class: "reason" }, "Nothing: this scene needs all there is."));
    this.leftOut.replaceChildren(...(entries.length > 0 ? entries : [none]));
  }

  /** The parameters of the simulation have changed; `what` says which, in a few words. */
  simulationChanged(what: string): void {
    this.errorCost.changed(what, performance.now());
  }

  /** Another scene: its figures are not to be compared with those of the one before. */
  sceneLoaded(): void {
    this.errorCost.clear();
  }

  welcomed(welcome: Welcome): void {
    this.welcome = welcome;
  }

  roundTripMeasured(time: number): void {
    this.roundTrip = time;
  }

  /** The connection is lost: figures of the past would pass for the present. */
  disconnected(): void {
    this.delay.forget();
    this.errorCost.clear();
    this.rate.clear();
    this.bytes.clear();
    this.stats = undefined;
    this.roundTrip = undefined;
    this.lastFrame = undefined;
    this.frameStages.clear();
    this.stepStages.clear();
    this.draw();
  }

  /** Median delay over the last second, ms. */
  delayNow(): number | undefined {
    return this.delay.median(performance.now());
  }

  private draw(): void {
    const now = performance.now();
    const { stats } = this;
    const frames = this.rate.count(now);
    const delay = this.delay.median(now);
    const rate = !this.lastFrame ? "–" : frames === 0 && stats?.paused ? "at rest" : `${frames} /s`;
    const speed = stats?.paused ? "paused" : factor(stats?.realTimeFactor);
    this.set("rate", rate, this.pictureInWords());
    this.set("delay", milliseconds(delay), this.lastFrame && bytesPerSecond(this.bytes.sum(now)));
    this.set("speed", speed);
    this.set("particles", count(stats?.particles));
    this.set("error", percent(stats?.meanDensityError), stats && `max ${percent(stats.maxDensityError)}`);
    this.set("step", milliseconds(stats && 1000 * stats.timeStepSeconds), stats?.timeStepLimit.replaceAll("_", " "));
    const brief = [rate, delay === undefined ? "" : milliseconds(delay), speed].filter((part) => part && part !== "–");
    setText(this.brief, brief.join(" · "));
    if (this.split.element.checkVisibility()) this.split.show(this.delay.meanParts(now));
    this.errorCost.draw();
    this.frameStages.draw();
    this.stepStages.draw();
    if (this.link.checkVisibility()) this.drawLink(now);
  }

  private set(name: FigureName, value: string, note: string | undefined = ""): void {
    setText(this.figures[name].value, value);
    setText(this.figures[name].note, note);
  }

  /** "H.264 · q 80", or "PNG · exact". */
  private pictureInWords(): string | undefined {
    const frame = this.lastFrame?.frame;
    if (!frame) return undefined;
    const grade = frame.codec === Codec.PNG ? "exact" : frame.quality > 0 ? `q ${frame.quality}` : "";
    return [codecName(frame.codec), grade].filter((part) => part !== "").join(" · ");
  }

  private drawLink(now: number): void {
    const frame = this.lastFrame?.frame;
    const lines: [string, string][] = [
      ["Round trip", milliseconds(this.roundTrip)],
      ["Pictures", frame ? `${frame.width} × ${frame.height} · ${this.pictureInWords()}` : "–"],
      ["Data", bytesPerSecond(this.bytes.sum(now))],
      ["Drawn by", this.welcome?.renderer || "–"],
      ["Server", this.welcome?.serverVersion || "–"],
    ];
    if (this.link.childElementCount !== 2 * lines.length) {
      this.link.replaceChildren(...lines.flatMap(([name]) => [h("dt", {}, name), h("dd")]));
    }
    lines.forEach(([, value], at) => setText(this.link.children[2 * at + 1] as HTMLElement, value));
  }
}

/** A part that folds; whether it is open is remembered. */
function section(title: string, body: HTMLElement): HTMLElement {
  const key = `section.${title}`;
  const details = h(
    "details",
    { class: "group level-2", open: remembered(key) === "open" },
    h("summary", {}, h("span", {}, title)),
    h("div", { class: "group-body" }, body),
  );
  details.addEventListener("toggle", () => remember(key, details.open ? "open" : "closed"));
  return details;
}

function leftOutOf(plan: Plan | undefined, where: string): HTMLElement[] {
  return (plan?.leftOut ?? []).map(({ name, reason }) =>
    h("li", { title: `left out of every ${where}` }, h("span", {}, name), h("span", { class: "reason" }, reason)),
  );
}
