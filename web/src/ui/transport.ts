// Play, pause, step and reset, the time of the simulation, and the keys for them.

import { Control_Action as Action } from "../gen/sluice/v1/session_pb";
import { seconds } from "../readout/format";
import { h, setText } from "./dom";
import { icon, type IconName } from "./icons";

export interface TransportHost {
  control(action: Action): void;
  resetCamera(inputTime: number): void;
  savePicture(): void;
}

export class Transport {
  private paused = false;
  /** Why this viewer may not drive the simulation, or undefined where it may. */
  private reason: string | undefined;
  private readonly driving: readonly { readonly button: HTMLButtonElement; readonly title: string }[];
  private readonly play = button("pause", "Pause", "Space");
  private readonly time = h("output", { class: "time", "aria-label": "Simulation time" }, "–");

  constructor(
    container: HTMLElement,
    private readonly host: TransportHost,
  ) {
    const reset = button("toStart", "Back to the start", "R");
    const step = button("step", "One step", "S");
    const view = button("view", "Reset the view", "Home");
    const save = button("save", "Save a lossless picture", "P");
    reset.addEventListener("click", () => host.control(Action.RESET));
    step.addEventListener("click", () => host.control(Action.STEP));
    this.play.addEventListener("click", () => this.toggle());
    view.addEventListener("click", (event) => host.resetCamera(event.timeStamp));
    save.addEventListener("click", () => host.savePicture());
    this.play.classList.add("play");
    this.driving = [reset, this.play, step].map((driven) => ({ button: driven, title: driven.title }));
    container.append(reset, this.play, step, this.time, h("span", { class: "rule" }), view, save);
    document.addEventListener("keydown", (event) => this.key(event));
  }

  show(paused: boolean, simulationTime: number | undefined): void {
    if (paused !== this.paused) {
      this.paused = paused;
      const label = paused ? "Play" : "Pause";
      this.play.replaceChildren(icon(paused ? "play" : "pause"));
      this.play.setAttribute("aria-label", label);
      this.play.title = this.reason ?? `${label} (Space)`;
    }
    setText(this.time, seconds(simulationTime));
  }

  forbid(reason: string | undefined): void {
    this.reason = reason;
    for (const { button: driven, title } of this.driving) {
      driven.disabled = reason !== undefined;
      driven.title = reason ?? title;
    }
  }

  private toggle(): void {
    this.host.control(this.paused ? Action.PLAY : Action.PAUSE);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || !isFree(event)) return;
    const actions: Record<string, () => void> = {
      " ": () => this.toggle(),
      s: () => this.host.control(Action.STEP),
      r: () => this.host.control(Action.RESET),
      p: () => this.host.savePicture(),
      c: () => this.host.resetCamera(event.timeStamp),
      Home: () => this.host.resetCamera(event.timeStamp),
    };
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }
}

/** Whether the key means nothing to the control that has the focus. */
function isFree(event: KeyboardEvent): boolean {
  const target = event.target instanceof HTMLElement ? event.target : undefined;
  if (!target) return true;
  if (target.matches("select, textarea, input:not([type=range], [type=checkbox], [type=radio])")) return false;
  const pressedBySpace = target.matches("button, summary, input[type=checkbox]");
  if (event.key === " " && pressedBySpace) return false;
  return !(event.key === "Home" && target.matches("input[type=range]"));
}

function button(name: IconName, label: string, key: string): HTMLButtonElement {
  return h("button", { type: "button", "aria-label": label, title: `${label} (${key})` }, icon(name));
}
