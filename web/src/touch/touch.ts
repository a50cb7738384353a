// Touching and reading the fluid: the tools, what they send, and what comes back.

import type { Scene } from "../gen/sluice/v1/scene_pb";
import type { Picked } from "../gen/sluice/v1/session_pb";
import type { Touch as TouchMessage } from "../protocol/session";
import { byId } from "../ui/dom";
import type { Camera } from "../view/camera";
import { rayThrough } from "../view/camera";
import type { Point } from "../view/picture_area";
import { TouchControls, type TouchHost } from "./controls";
import { PickCard } from "./pick_card";
import { Picker } from "./picker";
import { Stroke } from "./stroke";
import { kActions, type Tool, ToolSwitch, touches } from "./tools";

export interface FluidHost {
  camera(): Camera | undefined;
  /** Where a point of the page lies in the picture, and the picture's width over its height. */
  pointInPicture(at: Point): Point | undefined;
  pictureAspect(): number;
  interact(touch: TouchMessage): number;
  pick(x: number, y: number, camera: Camera): number;
}

export class Touch implements TouchHost {
  private readonly tools: ToolSwitch;
  private readonly stroke: Stroke;
  private readonly picker: Picker;
  private readonly card: PickCard;
  private readonly controls: TouchControls;
  private fluids: readonly string[] = [];
  private pointedAt: Point | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly host: FluidHost,
  ) {
    this.card = new PickCard(byId("pick", HTMLElement), byId("stage", HTMLElement));
    this.stroke = new Stroke((tool, ray) =>
      host.interact({ action: kActions[tool], origin: ray.origin, direction: ray.direction, fluid: this.tools.fluid }),
    );
    this.picker = new Picker(
      ({ x, y }) => {
        const camera = host.camera();
        return camera ? host.pick(x, y, camera) : 0;
      },
      (picked) => this.showPicked(picked),
    );
    this.tools = new ToolSwitch(byId("tools", HTMLElement), (tool) => this.toolChosen(tool));
    this.controls = new TouchControls(canvas, byId("crosshair", HTMLElement), this);
  }

  get tool(): Tool {
    return this.tools.current;
  }

  forbid(reasons: Partial<Record<Tool, string>>): void {
    this.tools.forbid(reasons);
  }

  sceneArrived(scene: Scene): void {
    const { source } = scene;
    this.fluids = source.case === "simulation" ? source.value.fluids.map(({ name }) => name) : [];
    this.tools.setFluids(this.fluids);
  }

  pictureChanged(): void {
    this.picker.pictureChanged();
  }

  picked(picked: Picked, sequence: number): void {
    this.picker.answered(sequence, picked);
  }

  /** A Done or an Error; false where it answers something else. */
  answered(sequence: number, refused: boolean): boolean {
    return this.stroke.answered(sequence, refused) || this.picker.answered(sequence, undefined);
  }

  /** The connection is lost, and with it every answer. */
  forget(): void {
    this.stroke.end();
    this.picker.leave();
  }

  // ------------------------------------------------------------------------------------- what fingers and keys do

  isActive(): boolean {
    return this.tool !== "turn" && this.host.camera() !== undefined;
  }

  point(at: Point | undefined): void {
    const inPicture = at && this.host.pointInPicture(at);
    this.stroke.aim(inPicture && this.rayAt(inPicture));
    if (this.tool !== "pick") return;
    this.picker.aim(inPicture);
    this.pointedAt = at;
    if (at) this.card.moveTo(at);
  }

  press(at: Point): void {
    const { tool } = this;
    const inPicture = this.host.pointInPicture(at);
    if (touches(tool)) this.stroke.begin(tool, inPicture && this.rayAt(inPicture));
    else this.point(at);
    this.canvas.classList.add("touching");
  }

  release(): void {
    this.stroke.end();
    this.canvas.classList.remove("touching");
  }

  private rayAt({ x, y }: Point) {
    const camera = this.host.camera();
    return camera && rayThrough(camera, this.host.pictureAspect(), x, y);
  }

  private showPicked(picked: Picked | undefined): void {
    this.card.show(picked, picked && this.fluids.length > 1 ? (this.fluids[picked.fluid] ?? "") : "");
    // Its size has changed with what it says.
    if (this.pointedAt) this.card.moveTo(this.pointedAt);
  }

  private toolChosen(tool: Tool): void {
    this.canvas.dataset["tool"] = tool;
    this.controls.reset();
    this.picker.leave();
  }
}
