import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";

import { BilateralSchema, SmoothingSchema, ThicknessSchema } from "../src/gen/sluice/v1/scene_pb";
import { labelOf } from "../src/params/annotations";
import { type ChoiceNode, fieldsIn, type GroupNode, type Node, parameterTree, shapeOf } from "../src/params/tree";
import { damBreak } from "./scene_fixture";

function find(path: string, nodes: readonly Node[] = parameterTree(damBreak())): Node | undefined {
  for (const node of nodes) {
    if (node.path === path) return node;
    const below = "children" in node ? find(path, node.children) : undefined;
    if (below) return below;
  }
  return undefined;
}

function field(path: string, scene = damBreak()) {
  const found = fieldsIn(parameterTree(scene)).find((candidate) => candidate.path === path);
  if (!found) throw new Error(`no field ${path}`);
  return found;
}

describe("parameterTree", () => {
  test("holds every scalar and vector of the scene once, under its path", () => {
    const paths = fieldsIn(parameterTree(damBreak())).map(({ path }) => path);
    expect(new Set(paths).size).toBe(paths.length);
    for (const path of [
      "look.smoothing.time",
      "look.smoothing.curvature_flow.step_fraction",
      "simulation.gravity",
      "simulation.fluids[0].viscosity",
      "simulation.fluids[0].blocks[1].first_particle",
      "simulation.dfsph.warm_start",
      "camera.vertical_fov_degrees",
      "title",
      "seed",
    ]) {
      expect(paths).toContain(path);
    }
    expect(paths).not.toContain("look.smoothing.bilateral.depth_deviation_in_radii");
  });

  test("takes unit, range, default, doc and restart from the annotations", () => {
    expect(field("look.smoothing.time")).toMatchObject({
      kind: "number",
      value: 2,
      standard: create(SmoothingSchema).time,
      integer: false,
      annotation: { unit: "d²", min: 0, max: 50, restart: false },
    });
    expect(field("look.smoothing.time").annotation.doc).toMatch(/^Smoothing time T/);
    expect(field("simulation.particle_spacing").annotation).toMatchObject({ restart: true, logarithmic: true });
  });

  test("gives each field the control of its kind", () => {
    expect(field("look.liquid.opaque").kind).toBe("toggle");
    expect(field("look.liquid.colour").kind).toBe("colour");
    expect(field("look.liquid.absorption").kind).toBe("vector");
    expect(field("title").kind).toBe("text");
    expect(field("seed")).toMatchObject({ kind: "number", integer: true, wide: true, value: 1 });
    expect(field("look.thickness.divisor")).toMatchObject({
      kind: "enum",
      value: 4,
      standard: create(ThicknessSchema).divisor,
    });
    expect(field("look.thickness.divisor")).toHaveProperty("options.length", 3);
  });

  test("reads the default of a vector from its text", () => {
    expect(field("simulation.gravity")).toMatchObject({ standard: { x: 0, y: -9.81, z: 0 } });
    expect(field("simulation.container.min")).toMatchObject({ standard: undefined });
  });

  test("shows a oneof as a choice with the parameters of the chosen member below", () => {
    const method = find("look.smoothing.method") as ChoiceNode;
    expect(method.kind).toBe("choice");
    expect(method.chosen).toBe("look.smoothing.curvature_flow");
    expect(method.options.map(({ path }) => path)).toContain("look.smoothing.bilateral");
    expect(method.options.every(({ available }) => available)).toBe(true);
    expect(method.children.map(({ path }) => path)).toContain("look.smoothing.curvature_flow.edge_in_radii");
  });

  test("does not offer members that only a scene file can fill in", () => {
    const source = find("source") as GroupNode;
    const choice = source.children[0] as ChoiceNode;
    const offered = Object.fromEntries(choice.options.map(({ path, available }) => [path, available]));
    expect(offered).toMatchObject({ simulation: false, particle_file: false, column_and_sheet: true });
  });

  test("has one shape for one set of controls, whatever the values", () => {
    const before = damBreak();
    const moved = damBreak();
    moved.look!.smoothing!.time = 9;
    expect(shapeOf(parameterTree(moved))).toBe(shapeOf(parameterTree(before)));
    moved.look!.smoothing!.method = { case: "bilateral", value: create(BilateralSchema) };
    expect(shapeOf(parameterTree(moved))).not.toBe(shapeOf(parameterTree(before)));
  });
});

test("labels are the field's name in words, without what its unit says", () => {
  expect(labelOf("refractive_index")).toBe("Refractive index");
  expect(labelOf("dfsph")).toBe("DFSPH");
  expect(labelOf("cfl")).toBe("CFL");
  expect(labelOf("radius_in_spacings", "d")).toBe("Radius");
  expect(labelOf("max_seconds", "s")).toBe("Max");
  expect(labelOf("vertical_fov_degrees", "°")).toBe("Vertical FOV");
  expect(labelOf("frames_per_second", "1/s")).toBe("Frames per second");
});
