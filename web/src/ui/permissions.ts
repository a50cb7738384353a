// What this viewer may do now, and why not where it may not.

import type { Touch } from "../touch/touch";
import { byId } from "./dom";
import type { SceneMenu } from "./scene_menu";
import type { Transport } from "./transport";
import { kSpectatorReason, type Viewers } from "./viewers";

const kFollowingReason = "Go back to your own camera first.";

export class Permissions {
  private readonly parameters = byId("parameters", HTMLFieldSetElement);
  private readonly note = byId("parameters-note", HTMLElement);

  constructor(
    private readonly viewers: Viewers,
    private readonly controls: { readonly transport: Transport; readonly menu: SceneMenu; readonly touch: Touch },
  ) {}

  show(): void {
    const spectating = this.viewers.isSpectator ? kSpectatorReason : undefined;
    const following = this.viewers.following !== 0n ? kFollowingReason : undefined;
    const { transport, menu, touch } = this.controls;
    transport.forbid(spectating);
    menu.forbid(spectating);
    this.parameters.disabled = spectating !== undefined;
    this.note.hidden = spectating === undefined;
    this.note.textContent = spectating ?? "";
    const touching = spectating ?? following;
    touch.forbid({
      ...(touching && { push: touching, pull: touching, add: touching }),
      ...(following && { pick: following }),
    });
  }
}
