import { clone } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";

import { SceneSchema } from "../src/gen/sluice/v1/scene_pb";
import { simulationChange } from "../src/params/change";
import { iterations, joules, perSecond } from "../src/readout/format";
import { History } from "../src/readout/history";
import { kSparkHeight, kSparkWidth, sparkPath } from "../src/readout/sparkline";
import { damBreak } from "./scene_fixture";

describe("a history", () => {
  test("keeps half a minute", () => {
    const history = new History();
    for (let at = 0; at <= 60_000; at += 500) history.add(at, at);
    expect(history.all[0]!.at).toBe(30_000);
    expect(history.last).toBe(60_000);
    history.add(61_000, Number.NaN);
    expect(history.last).toBe(60_000);
  });

  test("compares medians before and after a change, of ten seconds at most", () => {
    const history = new History();
    for (let at = 0; at < 20_000; at += 1000) history.add(at, at < 9000 ? 100 : 4);
    expect(history.beforeChange).toBeUndefined();
    history.mark(20_000, false);
    for (let at = 20_500; at < 23_000; at += 500) history.add(at, 9);
    expect(history.beforeChange).toBe(4);
    expect(history.sinceChange).toBe(9);
  });

  test("counts a slider's many changes as one", () => {
    const history = new History();
    history.add(0, 4);
    history.mark(100, false);
    history.add(200, 7);
    history.mark(300, true);
    history.add(400, 9);
    expect(history.beforeChange).toBe(4);
    expect(history.sinceChange).toBe(9);
  });
});

test("a sparkline ends at the right edge and fills its height", () => {
  const path = sparkPath([{ at: 0, value: 1 }, { at: 15_000, value: 3 }, { at: 30_000, value: 2 }]);
  const points = [...path.matchAll(/[ML]([\d.]+) ([\d.]+)/g)].map(([, x, y]) => [Number(x), Number(y)]);
  expect(points.map(([x]) => x)).toEqual([0, kSparkWidth / 2, kSparkWidth]);
  expect(points.map(([, y]) => y)).toEqual([kSparkHeight - 1.5, 1.5, kSparkHeight / 2]);
  expect(sparkPath([{ at: 0, value: 1 }])).toBe("");
});

describe("a change of the simulation", () => {
  test("is told by its parameter, with both values", () => {
    const before = damBreak();
    const after = clone(SceneSchema, before);
    if (after.source.case !== "simulation") throw new Error("no simulation");
    after.source.value.fluids[0]!.viscosity = 0.5;
    expect(simulationChange(before, after)).toBe("Viscosity 0.02 → 0.5");
    after.source.value.particleSpacing = 0.02;
    expect(simulationChange(before, after)).toMatch(/, and 1 more$/);
  });

  test("is none where only the look has changed", () => {
    const before = damBreak();
    const after = clone(SceneSchema, before);
    after.look!.smoothing!.time = 9;
    expect(simulationChange(before, after)).toBeUndefined();
    expect(simulationChange(before, clone(SceneSchema, before))).toBeUndefined();
  });

  test("shows when another method was chosen", () => {
    const before = damBreak();
    const after = clone(SceneSchema, before);
    if (after.source.case !== "simulation") throw new Error("no simulation");
    after.source.value.pressureSolver = { case: "iisph", value: { $typeName: "sluice.v1.Iisph" } as never };
    expect(simulationChange(before, after)).not.toBeUndefined();
  });
});

test("energies and rates have three digits and a unit", () => {
  expect(joules(0)).toBe("0 J");
  expect(joules(1234)).toBe("1.23 kJ");
  expect(joules(-0.0312)).toBe("−31.2 mJ");
  expect(joules(2.5e6)).toBe("2.50 MJ");
  expect(perSecond(12.34)).toBe("12.3 /s");
  expect(perSecond(undefined)).toBe("–");
  expect(iterations(3.5)).toBe("3.5");
});
