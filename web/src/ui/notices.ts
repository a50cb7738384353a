// Short messages that belong to no field: they go by themselves, or with their cross.

import { h } from "./dom";
import { icon } from "./icons";

const kSecondsPerNotice = 8;
const kMostNotices = 3;

export class Notices {
  constructor(private readonly container: HTMLElement) {}

  /** A lasting notice stays until it is closed or `remove` is called. */
  show(message: string, lasting = false): { remove(): void } {
    // The same message again adds nothing but its newness.
    for (const shown of this.container.children) if (shown.firstElementChild?.textContent === message) shown.remove();
    const close = h("button", { type: "button", "aria-label": "Close this message" }, icon("close", 12));
    const notice = h("div", { class: "notice", role: "alert" }, h("span", {}, message), close);
    const remove = () => notice.remove();
    close.addEventListener("click", remove);
    while (this.container.childElementCount >= kMostNotices) this.container.firstElementChild?.remove();
    this.container.append(notice);
    if (!lasting) setTimeout(remove, 1000 * kSecondsPerNotice);
    return { remove };
  }
}
