// How sharp and how compressed the pictures are to be.

import { Codec } from "../gen/sluice/v1/session_pb";
import { h } from "./dom";
import { remember, remembered } from "./preferences";
import { explain } from "./tooltip";

interface Choice {
  readonly label: string;
  readonly doc: string;
}

const kDetails: Record<string, Choice & { readonly detail: number }> = {
  full: { label: "Full", detail: 1, doc: "Every pixel of this screen." },
  reduced: { label: "¾", detail: 0.75, doc: "Three quarters of the screen's pixels along each edge." },
  half: { label: "½", detail: 0.5, doc: "Half of the screen's pixels along each edge: a quarter of the work." },
};

// Codecs best first; quality 0 is the server's own default.
const kCompressions: Record<string, Choice & { readonly codecs: readonly Codec[]; readonly quality: number }> = {
  lossless: { label: "Lossless", codecs: [Codec.PNG], quality: 0, doc: "Exact pictures; many times the data." },
  fine: { label: "Fine", codecs: [Codec.JPEG, Codec.PNG], quality: 95, doc: "Hardly to be told from lossless." },
  standard: { label: "Standard", codecs: [Codec.JPEG, Codec.PNG], quality: 0, doc: "The server's default." },
  light: { label: "Light", codecs: [Codec.JPEG, Codec.PNG], quality: 55, doc: "For slow connections." },
};

export interface PictureWish {
  readonly detail: number;
  readonly codecs: readonly Codec[];
  readonly quality: number;
}

export class PictureOptions {
  private detail: string;
  private compression: string;

  constructor(
    container: HTMLElement,
    private readonly onChange: () => void,
  ) {
    this.detail = known(kDetails, remembered("detail"), "full");
    this.compression = known(kCompressions, remembered("compression"), "standard");
    container.append(
      this.row("Detail", kDetails, this.detail, (value) => {
        this.detail = value;
        remember("detail", value);
      }),
      this.row("Compression", kCompressions, this.compression, (value) => {
        this.compression = value;
        remember("compression", value);
      }),
    );
  }

  wish(): PictureWish {
    const { codecs, quality } = kCompressions[this.compression]!;
    return { detail: kDetails[this.detail]!.detail, codecs, quality };
  }

  private row(label: string, choices: Record<string, Choice>, chosen: string, take: (value: string) => void): HTMLElement {
    const select = h("select", { "aria-label": label });
    for (const [value, choice] of Object.entries(choices)) {
      select.append(h("option", { value, selected: value === chosen }, choice.label));
    }
    select.addEventListener("change", () => {
      take(select.value);
      this.onChange();
    });
    const name = h("span", { class: "label" }, label);
    const row = h("div", { class: "row choice" }, h("div", { class: "line" }, name, select));
    explain(row, () => ({ text: choices[select.value]?.doc ?? "" }), name);
    return row;
  }
}

function known(choices: Record<string, unknown>, value: string | undefined, otherwise: string): string {
  return value !== undefined && Object.hasOwn(choices, value) ? value : otherwise;
}
