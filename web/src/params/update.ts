// One change by a person becomes an UpdateScene: a scene that holds the one value, and the mask that names it.

import { create, type MessageInitShape } from "@bufbuild/protobuf";
import { reflect } from "@bufbuild/protobuf/reflect";

import { SceneSchema, Vec3Schema } from "../gen/sluice/v1/scene_pb";
import type { UpdateSceneSchema } from "../gen/sluice/v1/session_pb";
import type { Vec3 } from "../view/camera";
import { makeParent } from "./path";

/** A field's new value; "present" and "absent" choose a oneof's member or switch a feature. */
export type Edit =
  | { readonly path: string; readonly value: number | bigint | boolean | string | Vec3 }
  | { readonly path: string; readonly message: "present" | "absent" };

export function updateFor(edit: Edit): MessageInitShape<typeof UpdateSceneSchema> {
  const scene = create(SceneSchema);
  const { parent, field } = makeParent(reflect(SceneSchema, scene), edit.path);
  if ("message" in edit) {
    if (edit.message === "present" && field.fieldKind === "message") parent.set(field, reflect(field.message));
  } else if (typeof edit.value === "object") {
    parent.set(field, reflect(Vec3Schema, create(Vec3Schema, edit.value)));
  } else {
    parent.set(field, edit.value);
  }
  return { scene, mask: { paths: [edit.path] } };
}
