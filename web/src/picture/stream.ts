// The stream of pictures: what is asked for, what is acknowledged, and what is done about pictures that fail.

import type { Codec, Frame, Limits, Welcome } from "../gen/sluice/v1/session_pb";
import type { Session } from "../protocol/session";
import { byId } from "../ui/dom";
import { PictureOptions } from "../ui/picture_options";
import type { CanvasSize } from "../view/canvas_size";
import { codecName } from "./codecs";
import { type DrawnFrame, Picture, pictureBlob } from "./picture";
import { pictureSize, type Size } from "./picture_size";

export interface StreamHost {
  onDrawn(drawn: DrawnFrame): void;
  report(message: string): void;
}

export class Stream {
  private readonly picture: Picture;
  private readonly options: PictureOptions;
  private limits: Limits | undefined;
  private joined = false;
  /** Whose pictures are asked for; 0 for those of the own camera. */
  private follow = 0n;

  /** `decodable` are the codecs of this browser, best first. */
  constructor(
    private readonly session: Session,
    private readonly canvasSize: CanvasSize,
    decodable: readonly Codec[],
    private readonly host: StreamHost,
  ) {
    this.picture = new Picture(byId("picture", HTMLCanvasElement), {
      onDrawn: (drawn) => {
        session.acknowledge(drawn.frame.frameId);
        host.onDrawn(drawn);
      },
      onDropped: (frame, reason) => this.dropped(frame, reason),
      onKeyframeNeeded: () => session.askForKeyframe(),
      onCodecFailing: (codec, reason) => this.codecFailing(codec, reason),
    });
    this.options = new PictureOptions(byId("picture-options", HTMLElement), decodable, () => this.ask());
  }

  /** The session has started, for the first time or again: with pictures of the own camera. */
  welcomed({ limits, codecs }: Welcome): void {
    this.joined = true;
    this.limits = limits;
    this.options.setServerCodecs(codecs);
    this.ask(0n);
  }

  /** The connection is gone. */
  forget(): void {
    this.joined = false;
    this.picture.forget();
  }

  /** Takes the payload of the frame over. */
  push(frame: Frame): void {
    this.picture.push(frame);
  }

  /** Asks for pictures of the canvas's size, and of the quality that was chosen. */
  ask(follow = this.follow): void {
    this.follow = follow;
    // The pictures of another viewer have the shape of that one's window.
    byId("stage", HTMLElement).classList.toggle("followed", follow !== 0n);
    if (this.joined) this.session.setView({ ...this.options.view(), ...this.size(), follow });
  }

  askForLossless(): void {
    if (!this.joined) return;
    const { width, height } = this.size();
    this.session.snapshot(width, height);
  }

  private size(): Size {
    const { devicePixels } = this.canvasSize;
    const { limits } = this;
    const limit = limits ? { width: limits.maxWidth, height: limits.maxHeight } : devicePixels;
    return pictureSize(devicePixels, this.options.scale(), limit);
  }

  private dropped(frame: Frame, reason: string | undefined): void {
    // It is acknowledged all the same: the window would stay full, and the stream would stand.
    this.session.acknowledge(frame.frameId);
    if (reason !== undefined) this.host.report(`A picture could not be decoded: ${reason}`);
  }

  private codecFailing(codec: Codec, reason: string): void {
    if (!this.options.giveUp(codec)) return;
    this.host.report(`${codecName(codec)} does not work in this browser (${reason}); another codec is used.`);
    this.ask();
  }
}

/** Hands the picture to the person as a file. */
export function saveFrame(frame: Frame, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(pictureBlob(frame));
  link.download = `${name}_${frame.simulationTime.toFixed(3)}s.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
