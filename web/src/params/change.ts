// What differs between two states of a scene, in a few words.

import { equals } from "@bufbuild/protobuf";

import { type Scene, SceneSchema } from "../gen/sluice/v1/scene_pb";
import { formatNumber } from "./control";
import { type FieldNode, fieldsIn, parameterTree } from "./tree";

/** What the particles depend on. */
const kSimulated = /^(simulation|bodies|quality|seed)\b/;

/**
 * The parameters of the simulation that changed, "tolerance 0.01 → 0.001"; undefined where none did. A chosen method
 * shows by its parameters.
 */
export function simulationChange(before: Scene, after: Scene): string | undefined {
  if (equals(SceneSchema, before, after)) return undefined;
  const old = simulated(before);
  const present = simulated(after);
  const changes = [...present].flatMap(([path, field]) => {
    const was = old.get(path);
    const now = inWords(field);
    if (was && inWords(was) === now) return [];
    return [was ? `${field.label} ${inWords(was)} → ${now}` : `${field.label} ${now}`];
  });
  if (changes.length === 0) return [...old.keys()].some((path) => !present.has(path)) ? "Another method" : undefined;
  const [first, ...others] = changes;
  return others.length > 0 ? `${first}, and ${others.length} more` : first;
}

function simulated(scene: Scene): Map<string, FieldNode> {
  const fields = fieldsIn(parameterTree(scene)).filter(({ path }) => kSimulated.test(path));
  return new Map(fields.map((field) => [field.path, field]));
}

function inWords(field: FieldNode): string {
  const { value } = field;
  if (typeof value === "number") return formatNumber(value);
  if (typeof value === "boolean") return value ? "on" : "off";
  if (typeof value === "object") return `(${[value.x, value.y, value.z].map(formatNumber).join(", ")})`;
  return String(value);
}
