// The camera of this viewer: the scene's until a person moves it.

import { equals } from "@bufbuild/protobuf";

import { CameraSchema, type Scene } from "../gen/sluice/v1/scene_pb";
import { type Camera, framed } from "./camera";

export class OwnCamera {
  private view: Camera | undefined;
  private scene: Scene | undefined;
  private sceneName = "";
  /** A person has left the camera that the scene gave. */
  private isOwn = false;
  /** When the oldest move that has not been sent was made; 0 where there is none. */
  private movedAt = 0;

  /** `aspect` is the canvas's width over its height; `send` is called once per animation frame at most. */
  constructor(
    private readonly aspect: () => number,
    private readonly send: (camera: Camera, inputTime: number) => void,
  ) {}

  get current(): Camera | undefined {
    return this.view;
  }

  move(camera: Camera, inputTime: number): void {
    this.view = camera;
    this.isOwn = true;
    if (this.movedAt !== 0) return;
    this.movedAt = inputTime;
    requestAnimationFrame(() => {
      if (this.movedAt !== 0 && this.view) this.send(this.view, this.movedAt);
      this.movedAt = 0;
    });
  }

  reset(inputTime: number): void {
    if (!this.scene) return;
    this.move(this.startOf(this.scene), inputTime);
    this.isOwn = false;
  }

  /** A view that is still the scene's is framed anew in a window of another shape. */
  resized(inputTime: number): void {
    if (!this.isOwn) this.reset(inputTime);
  }

  /** Takes the scene's camera over unless a person has left the same one; true where it brings another. */
  sceneArrived(scene: Scene, name: string): boolean {
    const before = this.scene?.camera;
    const sameStart = scene.camera && before && equals(CameraSchema, scene.camera, before) && name === this.sceneName;
    if (!sameStart) this.isOwn = false;
    this.scene = scene;
    this.sceneName = name;
    if (!this.isOwn) this.view = this.startOf(scene);
    return !sameStart;
  }

  sendNow(): void {
    if (this.view) this.send(this.view, performance.now());
  }

  /** The connection is lost; a move under way is sent with the next one. */
  forget(): void {
    this.movedAt = 0;
  }

  private startOf(scene: Scene): Camera {
    return framed(plainCamera(scene), this.aspect());
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
