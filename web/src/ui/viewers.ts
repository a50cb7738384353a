// Who looks on: what this viewer may do, who else is there, and whose pictures are shown.

import { Role, type ViewersChanged, type ViewersChanged_Viewer as Viewer } from "../gen/sluice/v1/session_pb";
import { h, setText } from "./dom";

export const kSpectatorReason = "You are looking on; only drivers change the scene.";

export class Viewers {
  private viewers: readonly Viewer[] = [];
  private self = 0n;
  private followed = 0n;
  private role = Role.ROLE_UNSPECIFIED;
  private readonly list = h("ul", { class: "viewers" });
  private readonly bannerText = h("span");

  /**
   * `place` is where the list and the number of viewers stand, `marks` what stands on the picture. `onFollow` is called
   * with 0 for the own camera.
   */
  constructor(
    private readonly place: { readonly list: HTMLElement; readonly count: HTMLElement },
    private readonly marks: { readonly following: HTMLElement; readonly role: HTMLElement },
    private readonly onFollow: (viewerId: bigint) => void,
  ) {
    place.list.append(this.list);
    const back = h("button", { type: "button" }, "Back to my camera");
    back.addEventListener("click", () => this.onFollow(0n));
    marks.following.append(this.bannerText, back);
    marks.role.title = kSpectatorReason;
    document.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.followed !== 0n) this.onFollow(0n);
    });
    this.show();
  }

  /** Whose pictures are shown; 0 for the own camera. */
  get following(): bigint {
    return this.followed;
  }

  get isSpectator(): boolean {
    return this.role === Role.SPECTATOR;
  }

  welcomed(self: bigint, role: Role): void {
    this.self = self;
    this.role = role;
    this.viewers = [];
    this.followed = 0n;
    this.show();
  }

  follow(viewerId: bigint): void {
    this.followed = viewerId;
    this.show();
  }

  /** True where the one that is followed has left, so that this viewer has its own camera again. */
  changed({ viewers }: ViewersChanged): boolean {
    this.viewers = viewers;
    this.role = viewers.find(({ viewerId }) => viewerId === this.self)?.role || this.role;
    const lost = this.followed !== 0n && !viewers.some(({ viewerId }) => viewerId === this.followed);
    if (lost) this.followed = 0n;
    this.show();
    return lost;
  }

  private show(): void {
    const others = this.viewers.length - 1;
    setText(this.place.count, others > 0 ? `${this.viewers.length}` : "");
    this.list.replaceChildren(...this.lines());
    this.marks.following.hidden = this.followed === 0n;
    setText(this.bannerText, `Following ${nameOf(this.followed)}`);
    this.marks.role.hidden = !this.isSpectator;
  }

  private lines(): HTMLElement[] {
    const own = this.viewers.find(({ viewerId }) => viewerId === this.self);
    const me = h("li", {}, described("You", own, this.role));
    const others = this.viewers.filter(({ viewerId }) => viewerId !== this.self);
    return [me, ...others.map((viewer) => this.lineOf(viewer))];
  }

  private lineOf(viewer: Viewer): HTMLElement {
    const { viewerId, follows } = viewer;
    const isFollowed = viewerId === this.followed;
    const why =
      follows === this.self && this.self !== 0n
        ? "This viewer follows you"
        : follows !== 0n
          ? `This viewer follows ${nameOf(follows)}: follow that one instead`
          : viewer.width === 0
            ? "This viewer is sent no pictures yet"
            : "";
    const button = h(
      "button",
      { type: "button", class: "small", "aria-pressed": String(isFollowed), disabled: why !== "" && !isFollowed, title: why },
      isFollowed ? "Leave" : "Follow",
    );
    button.addEventListener("click", () => this.onFollow(isFollowed ? 0n : viewerId));
    return h("li", {}, described(sentence(nameOf(viewerId)), viewer, viewer.role), button);
  }
}

function nameOf(viewerId: bigint): string {
  return `viewer ${viewerId}`;
}

function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function described(name: string, viewer: Viewer | undefined, role: Role): HTMLElement {
  const parts = [
    role === Role.DRIVER ? "drives" : role === Role.SPECTATOR ? "looks on" : "",
    viewer?.client ?? "",
    viewer && viewer.width > 0 ? `${viewer.width} × ${viewer.height}` : "",
    viewer && viewer.follows !== 0n ? `follows ${nameOf(viewer.follows)}` : "",
  ];
  return h(
    "span",
    { class: "who" },
    h("span", {}, name),
    h("span", { class: "note" }, parts.filter((part) => part !== "").join(" · ")),
  );
}
