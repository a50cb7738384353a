// Ties the page together: what arrives goes to the picture, the panel and the read-out; what people do goes out.

import type { Scene } from "./gen/sluice/v1/scene_pb";
import type {
  Codec,
  Control_Action,
  Error as ServerError,
  Frame,
  Picked,
  PlanChanged,
  SceneChanged,
  Stats,
  ViewersChanged,
  Welcome,
} from "./gen/sluice/v1/session_pb";
import { simulationChange } from "./params/change";
import { ParameterPanel } from "./params/panel";
import { updateFor } from "./params/update";
import { Updater } from "./params/updater";
import type { DrawnFrame } from "./picture/picture";
import { saveFrame, Stream } from "./picture/stream";
import type { ConnectionState, Socket } from "./protocol/connection";
import { Session, type SessionHandlers, type Touch as TouchMessage } from "./protocol/session";
import { Readout } from "./readout/readout";
import { type FluidHost, Touch } from "./touch/touch";
import { token, TokenPrompt } from "./ui/access";
import { byId } from "./ui/dom";
import { Notices } from "./ui/notices";
import { Permissions } from "./ui/permissions";
import { SceneChoice } from "./ui/scene_choice";
import { SceneMenu } from "./ui/scene_menu";
import { Status } from "./ui/status";
import { Transport, type TransportHost } from "./ui/transport";
import { kSpectatorReason, Viewers } from "./ui/viewers";
import type { Camera } from "./view/camera";
import { CanvasSize } from "./view/canvas_size";
import { type CameraHost, CameraControls } from "./view/controls";
import { OwnCamera } from "./view/own_camera";
import { type Point, pointInPicture } from "./view/picture_area";

/** The meaning of the messages that this page knows; see Welcome.protocol_version. */
const kProtocolVersion = 1;

export class App implements SessionHandlers, CameraHost, TransportHost, FluidHost {
  readonly session: Session;
  private readonly canvas = byId("picture", HTMLCanvasElement);
  private readonly canvasSize = new CanvasSize(this.canvas, () => this.resized());
  private readonly readout = new Readout(byId("readout", HTMLElement), byId("brief", HTMLElement));
  private readonly status = new Status(byId("stage", HTMLElement), byId("status", HTMLElement));
  private readonly notices = new Notices(byId("notices", HTMLElement));
  private readonly menu = new SceneMenu(byId("scene", HTMLSelectElement), (name) => this.sceneChoice.load(name));
  private readonly tokenPrompt = new TokenPrompt(byId("token", HTMLFormElement), () => this.session.start());
  private readonly ownCamera = new OwnCamera(
    () => this.canvasSize.aspect,
    (camera, inputTime) => this.readout.delay.sent(this.session.setCamera(camera), inputTime, performance.now()),
  );
  private readonly stream: Stream;
  private readonly viewers: Viewers;
  private readonly transport: Transport;
  private readonly updater: Updater;
  private readonly panel: ParameterPanel;
  private readonly touch: Touch;
  private readonly sceneChoice: SceneChoice;
  private readonly permissions: Permissions;

  private connection: ConnectionState = "stopped";
  private welcome: Welcome | undefined;
  private scene: Scene | undefined;
  private sceneName = "";
  private stats: Stats | undefined;
  private halt: { readonly reason: string; remove(): void } | undefined;
  private framesDrawn = 0;
  private lastFrame: Frame | undefined;

  /** `decodable` are the codecs of this browser, best first. */
  constructor(makeSocket: () => Socket, decodable: readonly Codec[]) {
    this.session = new Session(makeSocket, this, { token });
    this.stream = new Stream(this.session, this.canvasSize, decodable, {
      onDrawn: (drawn) => this.frameDrawn(drawn),
      report: (message) => this.notices.show(message),
    });
    this.viewers = new Viewers(
      { list: byId("viewers", HTMLElement), count: byId("viewer-count", HTMLElement) },
      { following: byId("following", HTMLElement), role: byId("role", HTMLElement) },
      (viewerId) => this.follow(viewerId),
    );
    this.transport = new Transport(byId("transport", HTMLElement), this);
    this.updater = new Updater(
      (edit) => this.sentNow(this.session.updateScene(updateFor(edit))),
      (path, error) => this.panel.settled(path, error),
    );
    this.panel = new ParameterPanel(byId("parameters", HTMLFieldSetElement), {
      submit: (edit) => this.updater.submit(edit),
      isBusy: (path) => this.updater.isBusy(path),
      report: (message) => this.notices.show(message),
    });
    new CameraControls(this.canvas, this);
    this.touch = new Touch(this.canvas, this);
    this.sceneChoice = new SceneChoice(this.session, this.menu, (message) => this.notices.show(message));
    const { transport, menu, touch } = this;
    this.permissions = new Permissions(this.viewers, { transport, menu, touch });
  }

  /** Facts about the page for whoever drives it from outside, such as its tests. */
  facts() {
    return {
      connection: this.connection,
      framesDrawn: this.framesDrawn,
      frame: this.lastFrame && {
        id: Number(this.lastFrame.frameId),
        width: this.lastFrame.width,
        height: this.lastFrame.height,
        codec: this.lastFrame.codec,
        still: this.lastFrame.still,
        reflectsSequence: Number(this.lastFrame.reflectsSequence),
        simulationTime: this.lastFrame.simulationTime,
      },
      viewerId: Number(this.welcome?.viewerId ?? 0),
      following: Number(this.viewers.following),
      camera: this.ownCamera.current,
      scene: this.scene,
      sceneName: this.sceneName,
      stats: this.stats,
      delayMilliseconds: this.readout.delayNow(),
    };
  }

  // ------------------------------------------------------------------------------------------ what the server says

  onState(state: ConnectionState, detail: string): void {
    this.connection = state;
    this.status.show(state, detail);
    if (state === "open") return;
    this.stream.forget();
    this.updater.forget();
    this.readout.disconnected();
    this.ownCamera.forget();
    this.touch.forget();
    this.sceneChoice.forget();
  }

  onRefused(reason: string): void {
    this.tokenPrompt.show(reason);
  }

  onSilence(silent: boolean): void {
    this.status.silence(silent);
  }

  onWelcome(welcome: Welcome): void {
    if (welcome.protocolVersion !== kProtocolVersion) {
      this.session.stop();
      this.status.show("stopped", "This page and the server are of different versions: please reload");
      return;
    }
    if (this.viewers.following !== 0n) this.notices.show("The connection was new: this is your own camera again.");
    this.welcome = welcome;
    this.tokenPrompt.hide();
    this.readout.welcomed(welcome);
    this.viewers.welcomed(welcome.viewerId, welcome.role);
    this.menu.setEntries(welcome.scenes);
    if (welcome.scene) this.sceneArrived(welcome.scene, welcome.sceneName);
    this.transport.show(welcome.paused, undefined);
    this.permissions.show();
    this.stream.welcomed(welcome);
    this.ownCamera.sendNow();
  }

  onFrame(frame: Frame): void {
    this.readout.bytesReceived(frame.payload.byteLength);
    if (frame.snapshot) saveFrame(frame, this.sceneName || "sluice");
    else this.stream.push(frame);
  }

  onStats(stats: Stats): void {
    this.stats = stats;
    this.readout.statsReceived(stats);
    this.transport.show(stats.paused, stats.simulationTime);
    if (stats.halted === (this.halt?.reason ?? "")) return;
    this.halt?.remove();
    const { halted: reason } = stats;
    this.halt = reason ? { reason, ...this.notices.show(`The simulation has stopped: ${reason}`, true) } : undefined;
  }

  onScene(changed: SceneChanged): void {
    if (changed.scene && this.sceneArrived(changed.scene, changed.sceneName)) this.ownCamera.sendNow();
  }

  onPlan(plan: PlanChanged): void {
    this.readout.planReceived(plan);
  }

  onViewers(changed: ViewersChanged): void {
    if (this.viewers.changed(changed)) {
      this.notices.show("The viewer you followed has left: this is your own camera again.");
      this.stream.ask(0n);
    }
    this.permissions.show();
  }

  onPicked(picked: Picked, sequence: number): void {
    this.touch.picked(picked, sequence);
  }

  onError(error: ServerError, sequence: number): void {
    this.readout.delay.refused(sequence);
    if (this.updater.answered(sequence, error.message)) return;
    this.touch.answered(sequence, true);
    this.sceneChoice.answered(sequence, true);
    if (error.fieldPath && this.panel.complain(error.fieldPath, error.message)) return;
    this.notices.show(error.fieldPath ? `${error.fieldPath}: ${error.message}` : error.message);
  }

  onDone(sequence: number): void {
    this.sceneChoice.answered(sequence, false);
    this.touch.answered(sequence, false);
    this.updater.answered(sequence);
  }

  onRoundTrip(milliseconds: number): void {
    this.readout.roundTripMeasured(milliseconds);
  }

  /** Takes over a scene; true where it brings a camera of its own. */
  private sceneArrived(scene: Scene, name: string): boolean {
    if (name !== this.sceneName) this.readout.sceneLoaded();
    const change = this.scene && name === this.sceneName ? simulationChange(this.scene, scene) : undefined;
    if (change !== undefined) this.readout.simulationChanged(change);
    this.scene = scene;
    this.sceneName = name;
    this.menu.show(name, scene.title);
    document.title = scene.title ? `${scene.title} · Sluice` : "Sluice";
    this.panel.setScene(scene);
    this.touch.sceneArrived(scene);
    return this.ownCamera.sceneArrived(scene, name);
  }

  // -------------------------------------------------------------------------------------------------- the pictures

  private frameDrawn(drawn: DrawnFrame): void {
    if (drawn.frame.snapshotSequence !== this.lastFrame?.snapshotSequence) this.touch.pictureChanged();
    this.framesDrawn += 1;
    this.lastFrame = drawn.frame;
    this.readout.frameDrawn(drawn);
    this.status.pictureDrawn();
  }

  private resized(): void {
    this.stream.ask();
    this.ownCamera.resized(performance.now());
  }

  private follow(viewerId: bigint): void {
    this.viewers.follow(viewerId);
    this.permissions.show();
    this.stream.ask(viewerId);
    if (viewerId === 0n) this.ownCamera.sendNow();
  }

  savePicture(): void {
    this.stream.askForLossless();
  }

  // ---------------------------------------------------------------------------------------------- what people do

  camera(): Camera | undefined {
    return this.viewers.following === 0n ? this.ownCamera.current : undefined;
  }

  moveCamera(camera: Camera, inputTime: number): void {
    this.ownCamera.move(camera, inputTime);
  }

  resetCamera(inputTime: number): void {
    if (this.viewers.following === 0n) this.ownCamera.reset(inputTime);
  }

  turns(): boolean {
    return this.touch.tool === "turn";
  }

  pictureAspect(): number {
    return this.lastFrame ? this.lastFrame.width / this.lastFrame.height : this.canvasSize.aspect;
  }

  pointInPicture(at: Point): Point | undefined {
    const picture = this.lastFrame ?? this.canvasSize.devicePixels;
    const fit = this.viewers.following !== 0n ? "contain" : "cover";
    return pointInPicture(this.canvas.getBoundingClientRect(), picture, fit, at);
  }

  interact(touch: TouchMessage): number {
    return this.session.interact(touch);
  }

  pick(x: number, y: number, camera: Camera): number {
    return this.session.pick(x, y, camera);
  }

  control(action: Control_Action): void {
    if (this.viewers.isSpectator) this.notices.show(kSpectatorReason);
    else this.session.control(action);
  }

  /** A scene file that was dropped on the page. */
  loadSceneText(text: string): void {
    if (this.viewers.isSpectator) this.notices.show(kSpectatorReason);
    else this.sceneChoice.loadText(text, this.welcome?.limits?.maxMessageBytes ?? 0);
  }

  private sentNow(sequence: number): number {
    this.readout.delay.sent(sequence, performance.now());
    return sequence;
  }
}
