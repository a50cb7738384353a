// The scene's parameters as a tree for the panel: built from the descriptors and the values, knowing no widget.

import { type DescField, type DescOneof, ScalarType } from "@bufbuild/protobuf";
import { type ReflectList, type ReflectMessage, reflect } from "@bufbuild/protobuf/reflect";

import { type Scene, SceneSchema } from "../gen/sluice/v1/scene_pb";
import type { Vec3 } from "../view/camera";
import {
  type Annotation,
  annotationOf,
  completesItself,
  defaultScalar,
  defaultVector,
  docOfChoice,
  isColour,
  isFeature,
  isVector,
  labelOf,
} from "./annotations";

interface Common {
  /** As in --set; unique in the tree. */
  readonly path: string;
  readonly label: string;
}

interface Field extends Common {
  readonly annotation: Annotation;
}

export interface NumberField extends Field {
  readonly kind: "number";
  readonly value: number;
  readonly standard: number | undefined;
  readonly integer: boolean;
  /** 64-bit integers travel as bigint. */
  readonly wide: boolean;
}

export interface ToggleField extends Field {
  readonly kind: "toggle";
  readonly value: boolean;
  readonly standard: boolean;
}

export interface TextField extends Field {
  readonly kind: "text";
  readonly value: string;
  readonly standard: string;
}

/** One of a few numbers or words: an enumeration's, or those that the annotation allows. */
export interface EnumField extends Field {
  readonly kind: "enum";
  readonly value: number | string;
  readonly standard: number | string | undefined;
  readonly options: readonly { readonly value: number | string; readonly label: string }[];
}

export interface VectorField extends Field {
  readonly kind: "vector" | "colour";
  readonly value: Vec3;
  readonly standard: Vec3 | undefined;
}

/** One member of a oneof, whose parameters follow. */
export interface ChoiceNode extends Common {
  readonly kind: "choice";
  readonly doc: string;
  /** Path of the chosen member. */
  readonly chosen: string | undefined;
  readonly options: readonly ChoiceOption[];
  readonly children: readonly Node[];
}

export interface ChoiceOption {
  readonly path: string;
  readonly label: string;
  readonly doc: string;
  /** False where the member needs values that only a scene file gives. */
  readonly available: boolean;
}

export interface GroupNode extends Common {
  readonly kind: "group";
  readonly doc: string;
  /** Present where the group may be absent, which switches off what it describes. */
  readonly on: boolean | undefined;
  readonly children: readonly Node[];
}

export type FieldNode = NumberField | ToggleField | TextField | EnumField | VectorField;
export type Node = FieldNode | ChoiceNode | GroupNode;

/** The groups of the panel, in order. Fields of the scene itself stand in a last group of their own. */
export function parameterTree(scene: Scene): GroupNode[] {
  const groups: GroupNode[] = [];
  const loose: Node[] = [];
  for (const node of nodesOf(reflect(SceneSchema, scene), "")) {
    if (node.kind === "group") groups.push(node);
    else if (node.kind === "choice") groups.push(groupOfChoice(node));
    else loose.push(node);
  }
  // The look is what people reach for first.
  groups.sort((a, b) => Number(b.path === "look") - Number(a.path === "look"));
  if (loose.length > 0) groups.push({ ...groupOf("(scene)", "Scene", "What the scene is called"), children: loose });
  return groups;
}

/** Every field below the nodes, in order. */
export function fieldsIn(nodes: readonly Node[]): FieldNode[] {
  return nodes.flatMap((node) => (node.kind === "group" || node.kind === "choice" ? fieldsIn(node.children) : [node]));
}

/** Equal for trees that need the same widgets, whatever their values. */
export function shapeOf(nodes: readonly Node[]): string {
  return nodes
    .map((node) => {
      if (node.kind === "group") return `${node.path}:${node.on}{${shapeOf(node.children)}}`;
      if (node.kind === "choice") return `${node.path}=${node.chosen}{${shapeOf(node.children)}}`;
      return node.path;
    })
    .join(";");
}

function nodesOf(message: ReflectMessage, prefix: string): Node[] {
  return message.members.flatMap((member) =>
    member.kind === "oneof" ? [choiceOf(message, member, prefix)] : fieldOf(message, member, prefix + member.name),
  );
}

function fieldOf(message: ReflectMessage, field: DescField, path: string): Node[] {
  const annotation = annotationOf(field);
  const common = { path, label: labelOf(field.name, annotation.unit), annotation };
  switch (field.fieldKind) {
    case "scalar":
      return scalarOf(message, field, common);
    case "enum":
      return [
        {
          ...common,
          kind: "enum",
          value: message.get(field),
          standard: field.getDefaultValue(),
          options: field.enum.values.map(({ number, name }) => ({ value: number, label: labelOf(name.toLowerCase()) })),
        },
      ];
    case "message": {
      const value = message.get(field);
      if (isVector(field)) {
        const kind = isColour(field) ? "colour" : "vector";
        return [{ ...common, kind, value: plainVector(value), standard: defaultVector(field) }];
      }
      const set = message.isSet(field);
      if (!set && !isFeature(field)) return [];
      return [
        {
          ...groupOf(path, common.label, annotation.doc),
          on: isFeature(field) ? set : undefined,
          children: set ? nodesOf(value, `${path}.`) : [],
        },
      ];
    }
    case "list": {
      if (field.listKind !== "message") return [];
      const elements = [...(message.get(field) as ReflectList<ReflectMessage>)];
      const label = labelOf(field.name.replace(/s$/, ""));
      return elements.map((element, index) => ({
        ...groupOf(`${path}[${index}]`, `${label} ${index + 1}`, annotation.doc),
        children: nodesOf(element, `${path}[${index}].`),
      }));
    }
    case "map":
      return [];
  }
}

const kWideTypes = new Set([ScalarType.INT64, ScalarType.UINT64, ScalarType.SINT64, ScalarType.FIXED64]);

function scalarOf(message: ReflectMessage, field: DescField & { fieldKind: "scalar" }, common: Field): Node[] {
  const value: unknown = message.get(field);
  const standard = defaultScalar(field);
  switch (typeof value) {
    case "boolean":
      return [{ ...common, kind: "toggle", value, standard: standard === true }];
    case "string":
      if (common.annotation.words.length > 0) {
        const options = ["", ...common.annotation.words].map((word) => ({
          value: word,
          label: word === "" ? "none" : labelOf(word),
        }));
        return [{ ...common, kind: "enum", value, standard: typeof standard === "string" ? standard : "", options }];
      }
      return [{ ...common, kind: "text", value, standard: typeof standard === "string" ? standard : "" }];
    case "number":
    case "bigint":
      if (typeof value === "number" && common.annotation.allowed.length > 0) {
        const options = common.annotation.allowed.map((allowed) => ({ value: allowed, label: String(allowed) }));
        return [{ ...common, kind: "enum", value, standard: Number(standard), options }];
      }
      return [
        {
          ...common,
          kind: "number",
          value: Number(value),
          standard: standard === undefined ? undefined : Number(standard),
          integer: field.scalar !== ScalarType.DOUBLE && field.scalar !== ScalarType.FLOAT,
          wide: kWideTypes.has(field.scalar),
        },
      ];
    default:
      return [];
  }
}

function choiceOf(message: ReflectMessage, oneof: DescOneof, prefix: string): ChoiceNode {
  const chosen = message.oneofCase(oneof);
  return {
    kind: "choice",
    path: prefix + oneof.name,
    label: labelOf(oneof.name),
    doc: docOfChoice(oneof),
    chosen: chosen && prefix + chosen.name,
    options: oneof.fields.map((field) => ({
      path: prefix + field.name,
      label: labelOf(field.name),
      doc: annotationOf(field).doc,
      available: field.fieldKind === "message" && completesItself(field.message),
    })),
    children:
      chosen?.fieldKind === "message" ? nodesOf(message.get(chosen), `${prefix}${chosen.name}.`) : [],
  };
}

/** A choice of the scene itself makes a group that is called what was chosen. */
function groupOfChoice(node: ChoiceNode): GroupNode {
  const chosen = node.options.find((option) => option.path === node.chosen);
  return { ...groupOf(node.path, chosen?.label ?? node.label, chosen?.doc ?? node.doc), children: [node] };
}

function groupOf(path: string, label: string, doc: string): GroupNode {
  return { kind: "group", path, label, doc, on: undefined, children: [] };
}

function plainVector(vector: ReflectMessage): Vec3 {
  const { x, y, z } = vector.message as unknown as Vec3;
  return { x, y, z };
}
