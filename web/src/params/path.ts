// Field paths as in --set: look.smoothing.time, simulation.fluids[0].viscosity.

import type { DescField } from "@bufbuild/protobuf";
import { isReflectList, isReflectMessage, type ReflectList, type ReflectMessage, reflect } from "@bufbuild/protobuf/reflect";

export interface Step {
  readonly name: string;
  /** Index into a repeated field. */
  readonly index: number | undefined;
}

export function parsePath(path: string): Step[] {
  return path.split(".").map((part) => {
    const match = /^([a-z_][a-z0-9_]*)(?:\[(\d+)\])?$/.exec(part);
    if (!match) throw new Error(`"${part}" in "${path}" is no field name`);
    return { name: match[1]!, index: match[2] === undefined ? undefined : Number(match[2]) };
  });
}

/** Whether `path` is `ancestor` or lies inside it. */
export function isWithin(path: string, ancestor: string): boolean {
  return path === ancestor || path.startsWith(`${ancestor}.`) || path.startsWith(`${ancestor}[`);
}

export function fieldNamed(message: ReflectMessage, name: string): DescField {
  const field = message.fields.find((candidate) => candidate.name === name);
  if (!field) throw new Error(`${message.desc.typeName} has no field ${name}`);
  return field;
}

/** The message that holds the last field of the path, and that field; messages on the way are made. */
export function makeParent(root: ReflectMessage, path: string): { parent: ReflectMessage; field: DescField } {
  const steps = parsePath(path);
  const last = steps.pop()!;
  let parent = root;
  for (const step of steps) parent = makeChild(parent, step);
  return { parent, field: fieldNamed(parent, last.name) };
}

function makeChild(parent: ReflectMessage, step: Step): ReflectMessage {
  const field = fieldNamed(parent, step.name);
  if (field.fieldKind === "list" && field.listKind === "message") {
    const list = parent.get(field) as ReflectList<ReflectMessage>;
    while (list.size <= (step.index ?? 0)) list.add(reflect(field.message));
    return list.get(step.index ?? 0)!;
  }
  if (field.fieldKind !== "message") throw new Error(`${step.name} holds no fields`);
  if (!parent.isSet(field)) parent.set(field, reflect(field.message));
  return parent.get(field) as ReflectMessage;
}

/** The message at a path, or undefined where the way there is not set. */
export function messageAt(root: ReflectMessage, path: string): ReflectMessage | undefined {
  let message: ReflectMessage | undefined = root;
  for (const step of parsePath(path)) {
    const field = fieldNamed(message, step.name);
    if (!message.isSet(field)) return undefined;
    const value: unknown = message.get(field);
    const child: unknown = isReflectList(value) ? value.get(step.index ?? 0) : value;
    if (!isReflectMessage(child)) return undefined;
    message = child;
  }
  return message;
}
