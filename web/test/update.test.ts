import { create } from "@bufbuild/protobuf";
import { reflect } from "@bufbuild/protobuf/reflect";
import { describe, expect, test, vi } from "vitest";

import { SceneSchema } from "../src/gen/sluice/v1/scene_pb";
import { UpdateSceneSchema } from "../src/gen/sluice/v1/session_pb";
import { isWithin, parsePath } from "../src/params/path";
import { type Edit, updateFor } from "../src/params/update";
import { Updater } from "../src/params/updater";

const update = (edit: Edit) => create(UpdateSceneSchema, updateFor(edit));

describe("updateFor", () => {
  test("holds the one value and the mask that names it", () => {
    const { scene, mask } = update({ path: "look.smoothing.time", value: 3 });
    expect(mask?.paths).toEqual(["look.smoothing.time"]);
    expect(scene?.look?.smoothing?.time).toBe(3);
    expect(reflect(SceneSchema, scene!).isSet(SceneSchema.field["title"]!)).toBe(false);
  });

  test("puts an element of a repeated field at its index", () => {
    const { scene } = update({ path: "simulation.fluids[0].blocks[2].count_x", value: 7 });
    const blocks = scene?.source.case === "simulation" ? scene.source.value.fluids[0]?.blocks : undefined;
    expect(blocks?.length).toBe(3);
    expect(blocks?.[2]?.countX).toBe(7);
  });

  test("takes vectors whole", () => {
    const { scene } = update({ path: "lighting.sun.direction", value: { x: 0, y: 1, z: 0.5 } });
    expect(scene?.lighting?.sun?.direction).toMatchObject({ x: 0, y: 1, z: 0.5 });
  });

  test("chooses a member by its empty message, and switches a message off by its absence", () => {
    const chosen = update({ path: "look.smoothing.bilateral", message: "present" });
    expect(chosen.scene?.look?.smoothing?.method.case).toBe("bilateral");
    const off = update({ path: "look.smoothing", message: "absent" });
    expect(off.scene?.look?.smoothing).toBeUndefined();
    expect(off.mask?.paths).toEqual(["look.smoothing"]);
  });

  test("refuses paths that the schema does not have", () => {
    expect(() => update({ path: "look.sheen", value: 1 })).toThrow("sluice.v1.Look has no field sheen");
    expect(() => update({ path: "look..time", value: 1 })).toThrow("no field name");
  });
});

test("paths are read as --set has them", () => {
  expect(parsePath("simulation.fluids[12].viscosity")).toEqual([
    { name: "simulation", index: undefined },
    { name: "fluids", index: 12 },
    { name: "viscosity", index: undefined },
  ]);
  expect(isWithin("look.smoothing.time", "look.smoothing")).toBe(true);
  expect(isWithin("look.smoothing_more", "look.smoothing")).toBe(false);
  expect(isWithin("simulation.fluids[0]", "simulation.fluids")).toBe(true);
});

describe("Updater", () => {
  function started() {
    let sequence = 0;
    const sent: Edit[] = [];
    const settled = vi.fn();
    const updater = new Updater((edit) => {
      sent.push(edit);
      sequence += 1;
      return sequence;
    }, settled);
    return { sent, settled, updater };
  }

  test("has one edit of a field under way, and the newest after it", () => {
    const { sent, settled, updater } = started();
    for (const value of [1, 2, 3]) updater.submit({ path: "a", value });
    expect(sent).toEqual([{ path: "a", value: 1 }]);
    expect(updater.answered(1)).toBe(true);
    expect(sent.at(-1)).toEqual({ path: "a", value: 3 });
    expect(settled).not.toHaveBeenCalled();
    updater.answered(2);
    expect(settled).toHaveBeenCalledWith("a", undefined);
    expect(updater.isBusy("a")).toBe(false);
  });

  test("lets different fields pass each other", () => {
    const { sent, settled, updater } = started();
    updater.submit({ path: "a", value: 1 });
    updater.submit({ path: "b", value: 2 });
    expect(sent.length).toBe(2);
    updater.answered(2, "too large");
    expect(settled).toHaveBeenCalledWith("b", "too large");
    expect(updater.isBusy("a")).toBe(true);
  });

  test("leaves answers to other messages alone", () => {
    expect(started().updater.answered(99, "no")).toBe(false);
  });

  test("settles everything when the connection is lost", () => {
    const { settled, updater } = started();
    updater.submit({ path: "a", value: 1 });
    updater.submit({ path: "a", value: 2 });
    updater.forget();
    expect(settled).toHaveBeenCalledExactlyOnceWith("a", undefined);
    expect(updater.isBusy("a")).toBe(false);
  });

  test("says so where nothing is connected", () => {
    const settled = vi.fn();
    new Updater(() => 0, settled).submit({ path: "a", value: 1 });
    expect(settled).toHaveBeenCalledWith("a", "Not connected");
  });
});
