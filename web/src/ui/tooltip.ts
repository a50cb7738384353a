// One tooltip for the whole page: after a moment's rest of the mouse, at once for the keyboard, on a tap of the label.

import { h, uniqueId } from "./dom";

export interface Hint {
  readonly text: string;
  /** Figures about the field, in smaller print. */
  readonly detail?: string;
}

const kRestMilliseconds = 350;
const kGap = 10;

const bubble = h("div", { id: uniqueId("tooltip"), class: "tooltip", role: "tooltip", hidden: true });
let timer: ReturnType<typeof setTimeout> | undefined;
let owner: HTMLElement | undefined;

/** Shows `hint` for `anchor`; `label` inside it, where given, is what a finger taps. */
export function explain(anchor: HTMLElement, hint: () => Hint, label?: HTMLElement): void {
  anchor.addEventListener("pointerenter", (event) => {
    if (event.pointerType !== "mouse") return;
    clearTimeout(timer);
    timer = setTimeout(() => show(anchor, hint()), kRestMilliseconds);
  });
  anchor.addEventListener("pointerleave", () => hide());
  anchor.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse") hide();
  });
  anchor.addEventListener("focusin", (event) => {
    if (event.target instanceof Element && event.target.matches(":focus-visible")) show(anchor, hint());
  });
  anchor.addEventListener("focusout", () => hide());
  label?.addEventListener("click", (event) => {
    if (event instanceof PointerEvent && event.pointerType === "touch") show(anchor, hint());
  });
}

export function hide(): void {
  clearTimeout(timer);
  bubble.hidden = true;
  owner?.removeAttribute("aria-describedby");
  owner = undefined;
}

function show(anchor: HTMLElement, { text, detail }: Hint): void {
  clearTimeout(timer);
  if (!anchor.isConnected || text === "") return;
  if (!bubble.isConnected) document.body.append(bubble);
  bubble.replaceChildren(h("p", {}, text), ...(detail ? [h("p", { class: "detail" }, detail)] : []));
  bubble.hidden = false;
  owner?.removeAttribute("aria-describedby");
  owner = anchor;
  anchor.setAttribute("aria-describedby", bubble.id);

  // Beside the panel where there is room, above or below the row on a phone.
  const row = anchor.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = bubble;
  const beside = row.left - width - kGap;
  const top = beside >= 8 ? row.top : row.top - height - 6 >= 8 ? row.top - height - 6 : row.bottom + 6;
  const left = beside >= 8 ? beside : row.left;
  bubble.style.left = `${Math.round(Math.max(8, Math.min(left, innerWidth - width - 8)))}px`;
  bubble.style.top = `${Math.round(Math.max(8, Math.min(top, innerHeight - height - 8)))}px`;
}

addEventListener("keydown", (event) => {
  if (event.key === "Escape") hide();
});
addEventListener("scroll", () => hide(), { capture: true, passive: true });
