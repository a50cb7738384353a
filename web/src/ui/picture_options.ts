// How sharp and how compressed the pictures are to be.

import { Codec, QualityMode } from "../gen/sluice/v1/session_pb";
import { sliderScale } from "../params/slider_scale";
import { codecName, isVideo } from "../picture/codecs";
import { codecsFor, commonCodecs, type QualityChoice, viewFor } from "../picture/quality";
import type { View } from "../protocol/session";
import { remember, remembered } from "./preferences";
import { type Choice, choiceRow, sliderRow, switchRow } from "./rows";

const kDetails: readonly (Choice & { readonly detail: number })[] = [
  { value: "full", label: "Full", detail: 1, doc: "Every pixel of this screen." },
  { value: "reduced", label: "¾", detail: 0.75, doc: "Three quarters of the screen's pixels along each edge." },
  { value: "half", label: "½", detail: 0.5, doc: "Half of the screen's pixels along each edge: a quarter of the work." },
];

const kModes: readonly (Choice & { readonly mode: QualityMode })[] = [
  {
    value: "automatic",
    label: "Automatic",
    mode: QualityMode.AUTOMATIC,
    doc: "As good as the link allows: first the quality falls, then the size, then the rate.",
  },
  {
    value: "quality",
    label: "Fixed quality",
    mode: QualityMode.FIXED_QUALITY,
    doc: "Always the same quality; a slow link costs pictures per second.",
  },
  {
    value: "rate",
    label: "Fixed bit rate",
    mode: QualityMode.FIXED_BIT_RATE,
    doc: "About the same amount of data whatever is shown. For video.",
  },
  {
    value: "lossless",
    label: "Lossless",
    mode: QualityMode.LOSSLESS,
    doc: "Every pixel as it was drawn, as PNG; many times the data.",
  },
];

const kBestCodec = "best";
const kQualityScale = sliderScale({ min: 1, max: 100, logarithmic: false }, 80, true)!;
const kRateScale = sliderScale({ min: 0.5, max: 100, logarithmic: true }, 8, false)!;

export class PictureOptions {
  private detail = kDetails.find(({ value }) => value === remembered("detail")) ?? kDetails[0]!;
  private mode = kModes.find(({ value }) => value === remembered("mode")) ?? kModes[0]!;
  private codec: Codec | undefined = Number(remembered("codec")) || undefined;
  private quality = within(remembered("quality"), 1, 100, 80);
  private rate = within(remembered("rate"), 0.5, 100, 8);
  private fullChroma = remembered("chroma") === "full";
  private still = remembered("still") !== "off";
  private common: readonly Codec[] = [Codec.JPEG];
  /** Codecs that this browser said it decodes, and did not. */
  private readonly failing = new Set<Codec>();

  private readonly details = choiceRow("Detail", (value) => {
    this.detail = kDetails.find((detail) => detail.value === value) ?? this.detail;
    this.changed("detail", value);
  });
  private readonly modes = choiceRow("Compression", (value) => {
    this.mode = kModes.find((mode) => mode.value === value) ?? this.mode;
    this.changed("mode", value);
  });
  private readonly qualities = sliderRow(
    "Level",
    "From 1, hardly to be recognised, to 100, hardly to be told from lossless.",
    kQualityScale,
    String,
    (value) => {
      this.quality = value;
      this.changed("quality", String(value));
    },
  );
  private readonly rates = sliderRow(
    "Bit rate",
    "Data per second at the full rate of pictures.",
    kRateScale,
    (value) => `${value} Mbit/s`,
    (value) => {
      this.rate = value;
      this.changed("rate", String(value));
    },
  );
  private readonly codecs = choiceRow("Codec", (value) => {
    this.codec = value === kBestCodec ? undefined : Number(value);
    this.changed("codec", value);
  });
  private readonly chroma = switchRow(
    "Full colour",
    "Colour as sharp as brightness, for pictures in false colours. JPEG only.",
    (on) => {
      this.fullChroma = on;
      this.changed("chroma", on ? "full" : "half");
    },
  );
  private readonly stills = switchRow(
    "Exact at rest",
    "When nothing has moved for a moment, the picture is sent once more, lossless.",
    (on) => {
      this.still = on;
      this.changed("still", on ? "on" : "off");
    },
  );

  constructor(
    container: HTMLElement,
    private readonly decodable: readonly Codec[],
    private readonly onChange: () => void,
  ) {
    this.details.setChoices(kDetails);
    const rows = [this.details, this.modes, this.qualities, this.rates, this.codecs, this.chroma, this.stills];
    container.append(...rows.map(({ element }) => element));
    this.show();
  }

  /** What the server encodes. */
  setServerCodecs(codecs: readonly Codec[]): void {
    const decodable = this.decodable.filter((codec) => !this.failing.has(codec));
    this.common = commonCodecs(decodable, codecs);
    this.show();
  }

  /** A codec that turned out not to work here is asked for no more. False where it was the last one. */
  giveUp(codec: Codec): boolean {
    this.failing.add(codec);
    const rest = this.common.filter((other) => other !== codec);
    if (rest.length === 0) return false;
    this.common = rest;
    this.show();
    return true;
  }

  /** Pixels asked for per pixel of the screen, along each edge. */
  scale(): number {
    return this.detail.detail;
  }

  view(): View {
    return viewFor(this.choice(), this.common);
  }

  private choice(): QualityChoice {
    return {
      mode: this.mode.mode,
      codec: this.codec,
      quality: this.quality,
      megabitsPerSecond: this.rate,
      fullChroma: this.fullChroma,
      still: this.still,
    };
  }

  private changed(name: string, value: string): void {
    remember(name, value);
    this.show();
    this.onChange();
  }

  private show(): void {
    const { mode, codecs } = this.view();
    this.details.show(this.detail.value);
    const hasVideo = this.common.some(isVideo);
    this.modes.setChoices(
      kModes.map((choice) => {
        if (hasVideo || choice.mode !== QualityMode.FIXED_BIT_RATE) return choice;
        return { ...choice, disabled: true, label: `${choice.label} (no video here)` };
      }),
    );
    this.modes.show(kModes.find((choice) => choice.mode === mode)!.value);
    this.qualities.element.hidden = mode !== QualityMode.FIXED_QUALITY;
    this.qualities.show(this.quality);
    this.rates.element.hidden = mode !== QualityMode.FIXED_BIT_RATE;
    this.rates.show(this.rate);
    this.showCodecs(codecsFor(mode!, this.common));
    this.chroma.element.hidden = codecs?.[0] !== Codec.JPEG;
    this.chroma.show(this.fullChroma);
    this.stills.element.hidden = mode === QualityMode.LOSSLESS;
    this.stills.show(this.still);
  }

  private showCodecs(possible: readonly Codec[]): void {
    const best = possible[0];
    const lossless = best === Codec.PNG && possible.length === 1;
    const doc = !possible.some(isVideo) && !lossless
      ? "Video needs a secure connection (https, or this machine itself) and a browser with WebCodecs."
      : "The best that this browser and the server both know.";
    this.codecs.setChoices([
      { value: kBestCodec, label: best === undefined ? "Best" : `Best (${codecName(best)})`, doc },
      ...(lossless ? [] : possible.map((codec) => ({ value: String(codec), label: codecName(codec), doc: docOf(codec) }))),
    ]);
    const chosen = this.codec !== undefined && possible.includes(this.codec) && !lossless;
    this.codecs.show(chosen ? String(this.codec) : kBestCodec);
  }
}

function docOf(codec: Codec): string {
  switch (codec) {
    case Codec.H264:
      return "Quick on both sides; the usual choice.";
    case Codec.VP9:
      return "Fewer bytes than H.264, a little slower.";
    case Codec.AV1:
      return "Fewest bytes, and the most work for the server.";
    case Codec.JPEG:
      return "Each picture by itself: more data, nothing to lose on the way.";
    default:
      return "Lossless; many times the data.";
  }
}

function within(text: string | undefined, least: number, most: number, otherwise: number): number {
  const value = Number(text);
  return value >= least && value <= most ? value : otherwise;
}
