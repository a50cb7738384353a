// What was picked, beside the cursor, in SI units.

import type { Vec3 } from "../gen/sluice/v1/scene_pb";
import type { Picked } from "../gen/sluice/v1/session_pb";
import { h, setText } from "../ui/dom";
import type { Point } from "../view/picture_area";

const kGap = 16;
/** To the picture's edge. */
const kMargin = 8;
const kRows = ["Position", "Depth", "Thickness", "Velocity", "Density"] as const;

export class PickCard {
  private readonly title = h("p", { class: "title" });
  private readonly list = h("dl");
  private readonly values: HTMLElement[] = [];

  constructor(
    private readonly card: HTMLElement,
    private readonly stage: HTMLElement,
  ) {
    for (const name of kRows) {
      const value = h("dd");
      this.values.push(value);
      this.list.append(h("dt", {}, name), value);
    }
    card.append(this.title, this.list);
  }

  /** `fluidName` is empty where the scene has a single fluid. */
  show(picked: Picked | undefined, fluidName: string): void {
    this.card.hidden = picked === undefined;
    if (!picked) return;
    this.list.hidden = !picked.hit;
    setText(this.title, picked.hit ? fluidName : "No fluid here");
    this.title.hidden = this.title.textContent === "";
    pickedInWords(picked).forEach((text, at) => setText(this.values[at]!, text));
  }

  /** `at` is in the page. The card keeps clear of the cursor and within the picture. */
  moveTo(at: Point): void {
    const room = this.stage.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = this.card;
    const x = at.x - room.left;
    const y = at.y - room.top;
    const fitsRight = x + kGap + width + kMargin <= room.width;
    const fitsLeft = x - kGap - width >= kMargin;
    const fitsBelow = y + kGap + height + kMargin <= room.height;
    // On a phone there is room neither right nor left; above it no finger hides it.
    const beside = fitsRight ? x + kGap : fitsLeft ? x - kGap - width : x - width / 2;
    const down = (fitsRight || fitsLeft) && fitsBelow ? y + kGap : y - kGap - height;
    const left = Math.max(kMargin, Math.min(beside, room.width - width - kMargin));
    const top = down >= kMargin ? down : y + kGap;
    this.card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
  }
}

/** In the order of the card's rows. */
export function pickedInWords(picked: Picked): string[] {
  const { position, velocity } = picked;
  const speed = velocity ? Math.hypot(velocity.x, velocity.y, velocity.z) : undefined;
  return [
    `${inWords(position)} m`,
    `${digits(picked.depth)} m`,
    `${digits(picked.thickness)} m`,
    speed === undefined ? "–" : `${digits(speed)} m/s\n${inWords(velocity)}`,
    `${digits(picked.density, 4)} kg/m³`,
  ];
}

function inWords(vector: Vec3 | undefined): string {
  return vector ? [vector.x, vector.y, vector.z].map((value) => signed(value)).join(", ") : "–";
}

/** Three digits at least, and never a power of ten. */
function digits(value: number, significant = 3): string {
  const size = Math.abs(value);
  const whole = size >= 1 ? Math.floor(Math.log10(size)) + 1 : 0;
  return value.toFixed(size < 1 ? significant : Math.max(0, significant - whole)).replace(/^-/, "−");
}

function signed(value: number): string {
  return value.toFixed(3).replace(/^-0\.000$/, "0.000").replace(/^-/, "−");
}
