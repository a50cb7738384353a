// How the way of a slider, t in [0, 1], maps to a value.

import type { Annotation } from "./annotations";

type Range = Pick<Annotation, "min" | "max" | "logarithmic">;

export interface SliderScale {
  /** Exact at both ends. */
  toValue(t: number): number;
  toWay(value: number): number;
  /** Way of one key press. */
  readonly step: number;
}

/** Where the default of a bent slider stands. */
const kStandardWay = 0.35;
/** A linear slider whose default lies nearer to its lower end than this would be all end. */
const kLinearFrom = 0.1;
/** Beyond this range a slider has no feel, and a number field serves better. */
const kWidestRange = 200;
const kFineStep = 0.005;

/**
 * The scale for a field, or undefined where its range suits no slider. Logarithmic fields move in powers; a range that
 * starts at 0 and whose default lies near it bends, so that small values have room.
 */
export function sliderScale(annotation: Range, standard: number | undefined, integer: boolean): SliderScale | undefined {
  const { min, max } = annotation;
  if (min === undefined || max === undefined || !(max > min)) return undefined;
  const span = max - min;
  if (annotation.logarithmic && min > 0) return rounded(logarithmic(min, max), integer);
  if (integer && span <= 20) return rounded({ ...linear(min, max), step: 1 / span }, true);
  const way = standard === undefined ? 0.5 : (standard - min) / span;
  if (min >= 0 && way > 0 && way < kLinearFrom) {
    return rounded(bent(min, max, Math.log(way) / Math.log(kStandardWay)), integer);
  }
  return span <= kWidestRange ? rounded(linear(min, max), integer) : undefined;
}

function linear(min: number, max: number): SliderScale {
  return { toValue: (t) => min + (max - min) * t, toWay: (value) => (value - min) / (max - min), step: kFineStep };
}

function logarithmic(min: number, max: number): SliderScale {
  const ratio = Math.log(max / min);
  return {
    toValue: (t) => (t >= 1 ? max : min * Math.exp(ratio * t)),
    toWay: (value) => (value <= min ? 0 : Math.log(value / min) / ratio),
    step: kFineStep,
  };
}

function bent(min: number, max: number, power: number): SliderScale {
  return {
    toValue: (t) => min + (max - min) * t ** power,
    toWay: (value) => Math.max(0, (value - min) / (max - min)) ** (1 / power),
    step: kFineStep,
  };
}

/** Sliders give round numbers: three significant digits, or whole ones; the ends stay what they are. */
function rounded(scale: SliderScale, integer: boolean): SliderScale {
  const round = (value: number) => (integer ? Math.round(value) : Number(value.toPrecision(3)));
  return { ...scale, toValue: (t) => (t <= 0 || t >= 1 ? scale.toValue(t) : round(scale.toValue(t))) };
}
