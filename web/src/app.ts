// Ties the page together: what arrives goes to the picture, the panel and the read-out; what people do goes out.

import { equals } from "@bufbuild/protobuf";

import { CameraSchema, type Scene } from "./gen/sluice/v1/scene_pb";
import type {
  Control_Action,
  Error as ServerError,
  Frame,
  PlanChanged,
  SceneChanged,
  Stats,
  Welcome,
} from "./gen/sluice/v1/session_pb";
import { ParameterPanel } from "./params/panel";
import { updateFor } from "./params/update";
import { Updater } from "./params/updater";
import type { ConnectionState, Socket } from "./protocol/connection";
import { Session, type SessionHandlers } from "./protocol/session";
import { Readout } from "./readout/readout";
import { byId } from "./ui/dom";
import { Notices } from "./ui/notices";
import { PictureOptions } from "./ui/picture_options";
import { SceneMenu } from "./ui/scene_menu";
import { Status } from "./ui/status";
import { Transport, type TransportHost } from "./ui/transport";
import { type Camera, framed } from "./view/camera";
import { type CameraHost, CameraControls } from "./view/controls";
import { type DrawnFrame, Picture, pictureBlob } from "./view/picture";
import { pictureSize, type Size } from "./view/picture_size";

/** The meaning of the messages that this page knows; see Welcome.protocol_version. */
const kProtocolVersion = 1;
/** A window that is being dragged to size asks for pictures of its new size when it rests this long. */
const kResizeMilliseconds = 120;

export class App implements SessionHandlers, CameraHost, TransportHost {
  readonly session: Session;
  private readonly canvas = byId("picture", HTMLCanvasElement);
  private readonly picture: Picture;
  private readonly readout = new Readout(byId("readout", HTMLElement), byId("brief", HTMLElement));
  private readonly status = new Status(byId("stage", HTMLElement), byId("status", HTMLElement));
  private readonly notices = new Notices(byId("notices", HTMLElement));
  private readonly options: PictureOptions;
  private readonly menu: SceneMenu;
  private readonly transport: Transport;
  private readonly updater: Updater;
  private readonly panel: ParameterPanel;

  private connection: ConnectionState = "stopped";
  private welcome: Welcome | undefined;
  private scene: Scene | undefined;
  private sceneName = "";
  private stats: Stats | undefined;
  private halt: { readonly reason: string; remove(): void } | undefined;
  private view: Camera | undefined;
  /** The person has left the camera that the scene gave. */
  private viewIsOwn = false;
  /** When the oldest camera move that has not been sent was made; 0 where there is none. */
  private movedAt = 0;
  private devicePixels: Size = devicePixelsOf(this.canvas);
  private resizing: ReturnType<typeof setTimeout> | undefined;
  /** Sequence number of the scene choice under way. */
  private loading = 0;
  private framesDrawn = 0;
  private lastFrame: Frame | undefined;

  constructor(makeSocket: () => Socket) {
    this.session = new Session(makeSocket, this);
    this.picture = new Picture(
      this.canvas,
      (drawn) => this.frameDrawn(drawn),
      (frame, reason) => this.frameBroken(frame, reason),
    );
    this.options = new PictureOptions(byId("picture-options", HTMLElement), () => this.askForPictures());
    this.menu = new SceneMenu(byId("scene", HTMLSelectElement), (name) => this.loadScene(name));
    this.transport = new Transport(byId("transport", HTMLElement), this);
    this.updater = new Updater(
      (edit) => this.sentNow(this.session.updateScene(updateFor(edit))),
      (path, error) => this.panel.settled(path, error),
    );
    this.panel = new ParameterPanel(byId("parameters", HTMLElement), {
      submit: (edit) => this.updater.submit(edit),
      isBusy: (path) => this.updater.isBusy(path),
      report: (message) => this.notices.show(message),
    });
    new CameraControls(this.canvas, this);
    this.watchSize();
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
        reflectsSequence: Number(this.lastFrame.reflectsSequence),
        simulationTime: this.lastFrame.simulationTime,
      },
      camera: this.view,
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
    this.picture.forget();
    this.updater.forget();
    this.readout.disconnected();
    this.movedAt = 0;
    if (this.loading !== 0) this.menu.revert();
    this.loading = 0;
  }

  onWelcome(welcome: Welcome): void {
    if (welcome.protocolVersion !== kProtocolVersion) {
      this.session.stop();
      this.status.show("stopped", "This page and the server are of different versions: please reload");
      return;
    }
    this.welcome = welcome;
    this.readout.welcomed(welcome);
    this.menu.setEntries(welcome.scenes);
    if (welcome.scene) this.sceneArrived(welcome.scene, welcome.sceneName);
    this.transport.show(welcome.paused, undefined);
    this.askForPictures();
    if (this.view) this.sendCamera(this.view, performance.now());
  }

  onFrame(frame: Frame): void {
    this.readout.bytesReceived(frame.payload.byteLength);
    if (frame.snapshot) this.download(frame);
    else this.picture.push(frame);
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
    if (!changed.scene) return;
    const moved = this.sceneArrived(changed.scene, changed.sceneName);
    if (moved && this.view) this.sendCamera(this.view, performance.now());
  }

  onPlan(plan: PlanChanged): void {
    this.readout.planReceived(plan);
  }

  onError(error: ServerError, sequence: number): void {
    this.readout.delay.refused(sequence);
    if (this.updater.answered(sequence, error.message)) return;
    if (sequence !== 0 && sequence === this.loading) {
      this.loading = 0;
      this.menu.revert();
    }
    if (error.fieldPath && this.panel.complain(error.fieldPath, error.message)) return;
    this.notices.show(error.fieldPath ? `${error.fieldPath}: ${error.message}` : error.message);
  }

  onDone(sequence: number): void {
    if (sequence === this.loading) this.loading = 0;
    this.updater.answered(sequence);
  }

  onRoundTrip(milliseconds: number): void {
    this.readout.roundTripMeasured(milliseconds);
  }

  /** Takes over a scene; true where it brings a camera of its own. */
  private sceneArrived(scene: Scene, name: string): boolean {
    const { camera } = scene;
    const before = this.scene?.camera;
    const sameStart = camera && before && equals(CameraSchema, camera, before) && name === this.sceneName;
    if (!sameStart) this.viewIsOwn = false;
    this.scene = scene;
    this.sceneName = name;
    this.menu.show(name, scene.title);
    document.title = scene.title ? `${scene.title} · Sluice` : "Sluice";
    this.panel.setScene(scene);
    if (!this.viewIsOwn) this.view = this.startOf(scene);
    return !sameStart;
  }

  // -------------------------------------------------------------------------------------------------- the pictures

  private frameDrawn(drawn: DrawnFrame): void {
    const { frame } = drawn;
    this.session.acknowledge(frame.frameId);
    this.framesDrawn += 1;
    this.lastFrame = frame;
    this.readout.frameDrawn(drawn);
    this.status.pictureDrawn();
  }

  private frameBroken(frame: Frame, reason: unknown): void {
    // It is acknowledged all the same: the window would stay full, and the stream would stand.
    this.session.acknowledge(frame.frameId);
    this.notices.show(`A picture could not be decoded: ${reason instanceof Error ? reason.message : String(reason)}`);
  }

  private watchSize(): void {
    const observer = new ResizeObserver(([entry]) => {
      const box = entry?.devicePixelContentBoxSize?.[0];
      const size = exactSize(devicePixelsOf(this.canvas), box);
      if (size.width === this.devicePixels.width && size.height === this.devicePixels.height) return;
      this.devicePixels = size;
      clearTimeout(this.resizing);
      this.resizing = setTimeout(() => this.resized(), kResizeMilliseconds);
    });
    try {
      observer.observe(this.canvas, { box: "device-pixel-content-box" });
    } catch {
      // Safari knows only CSS pixels.
      observer.observe(this.canvas);
    }
  }

  private resized(): void {
    this.askForPictures();
    // A view that is still the scene's is framed anew.
    if (this.scene && !this.viewIsOwn) this.resetCamera(performance.now());
  }

  private pictureSize(): Size {
    const { limits } = this.welcome!;
    const limit = limits ? { width: limits.maxWidth, height: limits.maxHeight } : this.devicePixels;
    return pictureSize(this.devicePixels, this.options.wish().detail, limit);
  }

  private askForPictures(): void {
    if (!this.welcome || this.connection !== "open") return;
    const { codecs, quality } = this.options.wish();
    const offered = codecs.filter((codec) => this.welcome!.codecs.includes(codec));
    this.session.setView({ ...this.pictureSize(), codecs: offered.length > 0 ? offered : codecs, quality });
  }

  savePicture(): void {
    if (!this.welcome || this.connection !== "open") return;
    const { width, height } = this.pictureSize();
    this.session.snapshot(width, height);
  }

  private download(frame: Frame): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(pictureBlob(frame));
    link.download = `${this.sceneName || "sluice"}_${frame.simulationTime.toFixed(3)}s.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }

  // ---------------------------------------------------------------------------------------------- what people do

  camera(): Camera | undefined {
    return this.view;
  }

  moveCamera(camera: Camera, inputTime: number): void {
    this.view = camera;
    this.viewIsOwn = true;
    if (this.movedAt !== 0) return;
    // Moves within one animation frame become one message.
    this.movedAt = inputTime;
    requestAnimationFrame(() => {
      if (this.movedAt !== 0 && this.view) this.sendCamera(this.view, this.movedAt);
      this.movedAt = 0;
    });
  }

  resetCamera(inputTime: number): void {
    if (!this.scene) return;
    this.moveCamera(this.startOf(this.scene), inputTime);
    this.viewIsOwn = false;
  }

  control(action: Control_Action): void {
    this.session.control(action);
  }

  private loadScene(name: string): void {
    this.loading = this.session.loadScene(name);
    if (this.loading === 0) this.menu.revert();
  }

  /** A scene file that was dropped on the page. */
  loadSceneText(text: string): void {
    const most = this.welcome?.limits?.maxMessageBytes ?? 0;
    // A server closes the connection over a message that is too large. A character takes three bytes at most.
    if (most > 0 && 3 * text.length + 64 > most) {
      this.notices.show("This file is too large for a scene.");
      return;
    }
    this.loading = this.session.loadSceneText(text);
  }

  private sendCamera(camera: Camera, inputTime: number): void {
    this.readout.delay.sent(this.session.setCamera(camera), inputTime);
  }

  private sentNow(sequence: number): number {
    this.readout.delay.sent(sequence, performance.now());
    return sequence;
  }

  private startOf(scene: Scene): Camera {
    return framed(plainCamera(scene), this.devicePixels.width / this.devicePixels.height);
  }
}

/** The camera that a scene names. The server sends scenes complete, with every vector set. */
function plainCamera(scene: Scene): Camera {
  const plain = (v: { x: number; y: number; z: number } | undefined) => ({ x: v?.x ?? 0, y: v?.y ?? 0, z: v?.z ?? 0 });
  const { camera } = scene;
  return {
    eye: plain(camera?.eye),
    target: plain(camera?.target),
    up: plain(camera?.up),
    verticalFovDegrees: camera?.verticalFovDegrees ?? 45,
  };
}

/** To within a pixel; the size observer knows exactly. */
function devicePixelsOf({ clientWidth, clientHeight }: HTMLCanvasElement): Size {
  return { width: clientWidth * devicePixelRatio, height: clientHeight * devicePixelRatio };
}

/** What the observer says, unless it has missed the density of the screen, as it does where tools emulate one. */
function exactSize(near: Size, box: ResizeObserverSize | undefined): Size {
  if (!box) return near;
  const agrees = Math.abs(box.inlineSize - near.width) < 2 && Math.abs(box.blockSize - near.height) < 2;
  return agrees ? { width: box.inlineSize, height: box.blockSize } : near;
}
