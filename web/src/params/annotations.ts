// What scene.proto says about its fields, read off the descriptors by reflection.

import { type DescField, type DescMessage, type DescOneof, getOption } from "@bufbuild/protobuf";

import { Apply, choice, type FieldInfo, info } from "../gen/sluice/v1/options_pb";
import { Vec3Schema } from "../gen/sluice/v1/scene_pb";
import type { Vec3 } from "../view/camera";

export type Scalar = number | bigint | boolean | string;

export interface Annotation {
  readonly doc: string;
  readonly unit: string;
  readonly min: number | undefined;
  readonly max: number | undefined;
  /** The particles start again when the value changes. */
  readonly restart: boolean;
  readonly logarithmic: boolean;
  /** The only values there are; empty for any within the range. */
  readonly allowed: readonly number[];
  /** The only words that a text may be, besides none; empty for any text. */
  readonly words: readonly string[];
}

export function annotationOf(field: DescField): Annotation {
  const given: FieldInfo = getOption(field, info);
  return {
    doc: given.doc,
    unit: given.unit,
    min: given.min,
    max: given.max,
    restart: given.apply === Apply.RESTART,
    logarithmic: given.logarithmic,
    allowed: given.allowed,
    words: given.words,
  };
}

export const isColour = (field: DescField): boolean => getOption(field, info).colour;
export const isFeature = (field: DescField): boolean => getOption(field, info).feature;
export const isRequired = (field: DescField): boolean => getOption(field, info).required;
export const docOfChoice = (oneof: DescOneof): string => getOption(oneof, choice).doc;

export const isVector = (field: DescField): boolean =>
  field.fieldKind === "message" && field.message.typeName === Vec3Schema.typeName;

/** Whether the server can fill the message in from nothing but its defaults. */
export function completesItself(message: DescMessage): boolean {
  return message.fields.every(
    (field) => !isRequired(field) && !(field.fieldKind === "list" && getOption(field, info).minItems > 0),
  );
}

export function defaultScalar(field: DescField): Scalar | undefined {
  if (field.fieldKind !== "scalar" && field.fieldKind !== "enum") return undefined;
  const value = field.getDefaultValue();
  return value instanceof Uint8Array ? undefined : value;
}

/** The vector that default_text names ("y: -9.81"); undefined where the annotation has none. */
export function defaultVector(field: DescField): Vec3 | undefined {
  const text = getOption(field, info).defaultText;
  if (text === "") return undefined;
  const components = { x: 0, y: 0, z: 0 };
  for (const [, axis, value] of text.matchAll(/([xyz])\s*:\s*([-+.\deE]+)/g)) {
    components[axis as "x" | "y" | "z"] = Number(value);
  }
  return components;
}

/** Initials that have a vowel; those without are known by that. */
const kInitials = new Set(["fov", "iisph", "pcisph"]);

/**
 * A field's name for people: "refractive_index" → "Refractive index", "dfsph" → "DFSPH". What the unit says already is
 * left out: "radius_in_spacings" in d → "Radius", "max_seconds" in s → "Max".
 */
export function labelOf(name: string, unit = ""): string {
  const short = unit === "" ? name : name.replace(/_(in_[a-z]+|seconds|degrees)$/, "");
  const isInitials = (word: string) => kInitials.has(word) || (word.length > 1 && !/[aeiouy]/.test(word));
  const text = short
    .split("_")
    .map((word) => (isInitials(word) ? word.toUpperCase() : word))
    .join(" ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}
