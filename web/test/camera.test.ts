import { describe, expect, test } from "vitest";

import { type Camera, distanceOf, framed, kMaxDistance, kMinDistance, orbit, pan, rayThrough, viewAxes, zoom } from "../src/view/camera";
import { keyMove } from "../src/view/controls";

const camera: Camera = {
  eye: { x: 1.5, y: 1.35, z: 2.6 },
  target: { x: 0, y: 0.35, z: 0 },
  up: { x: 0, y: 1, z: 0 },
  verticalFovDegrees: 45,
};

const elevation = (c: Camera) => Math.asin((c.eye.y - c.target.y) / distanceOf(c));
const dot = (a: Camera["eye"], b: Camera["eye"]) => a.x * b.x + a.y * b.y + a.z * b.z;

describe("orbit", () => {
  test("keeps the target and the distance", () => {
    const moved = orbit(camera, 1.1, -0.4);
    expect(moved.target).toEqual(camera.target);
    expect(distanceOf(moved)).toBeCloseTo(distanceOf(camera), 12);
  });

  test("by a full turn comes back", () => {
    const { eye } = orbit(camera, 2 * Math.PI, 0);
    expect(eye.x).toBeCloseTo(camera.eye.x, 12);
    expect(eye.y).toBeCloseTo(camera.eye.y, 12);
    expect(eye.z).toBeCloseTo(camera.eye.z, 12);
  });

  test("with positive pitch lifts the eye by that angle", () => {
    expect(elevation(orbit(camera, 0, 0.2))).toBeCloseTo(elevation(camera) + 0.2, 12);
  });

  test("with positive yaw moves the eye to its right", () => {
    const { right } = viewAxes(camera);
    const moved = orbit(camera, 0.1, 0).eye;
    expect(dot({ x: moved.x - camera.eye.x, y: moved.y - camera.eye.y, z: moved.z - camera.eye.z }, right)).toBeGreaterThan(0);
  });

  test("stops short of both poles and never flips over", () => {
    let top = camera;
    for (let n = 0; n < 50; n += 1) top = orbit(top, 0, 0.3);
    expect(elevation(top)).toBeCloseTo(Math.PI / 2 - Math.PI / 180, 6);
    let bottom = camera;
    for (let n = 0; n < 50; n += 1) bottom = orbit(bottom, 0, -0.3);
    expect(elevation(bottom)).toBeCloseTo(-Math.PI / 2 + Math.PI / 180, 6);
  });

  test("comes back from a camera that looks straight down", () => {
    const down: Camera = { ...camera, eye: { x: 0, y: 5, z: 0 }, target: { x: 0, y: 0, z: 0 } };
    expect(elevation(orbit(down, 0, 0.3))).toBeCloseTo(Math.PI / 2, 6);
    expect(elevation(orbit(down, 0, -0.3))).toBeCloseTo(Math.PI / 2 - 0.3, 6);
  });

  test("turns about whatever axis is up", () => {
    const tilted: Camera = { ...camera, up: { x: 0, y: 0, z: 1 } };
    expect(orbit(tilted, 0.7, 0).eye.z).toBeCloseTo(camera.eye.z, 12);
  });
});

describe("pan", () => {
  test("by one picture height moves the target by what the picture shows", () => {
    const moved = pan(camera, 0, 1);
    const shown = 2 * distanceOf(camera) * Math.tan(Math.PI / 8);
    const way = { x: moved.target.x, y: moved.target.y - 0.35, z: moved.target.z };
    expect(Math.hypot(way.x, way.y, way.z)).toBeCloseTo(shown, 9);
    expect(dot(way, viewAxes(camera).forward)).toBeCloseTo(0, 9);
  });

  test("moves the eye as far as the target", () => {
    expect(distanceOf(pan(camera, 0.3, -0.8))).toBeCloseTo(distanceOf(camera), 9);
  });
});

describe("zoom", () => {
  test("multiplies the distance along the line of sight", () => {
    const near = zoom(camera, 0.5);
    expect(distanceOf(near)).toBeCloseTo(distanceOf(camera) / 2, 12);
    expect(dot(viewAxes(near).forward, viewAxes(camera).forward)).toBeCloseTo(1, 12);
  });

  test("stays within what the server takes", () => {
    expect(distanceOf(zoom(camera, 0))).toBeCloseTo(kMinDistance, 9);
    expect(distanceOf(zoom(camera, 1e12))).toBeCloseTo(kMaxDistance, 3);
  });

  test("gives a camera whose eye lies on its target a distance again", () => {
    const nowhere: Camera = { ...camera, eye: camera.target };
    expect(distanceOf(zoom(nowhere, 2))).toBeCloseTo(kMinDistance, 9);
  });
});

describe("viewAxes", () => {
  test("are orthonormal for every camera, also along the up axis", () => {
    for (const eye of [camera.eye, { x: 0, y: 9, z: 0 }, { x: 0, y: -9, z: 0 }, camera.target]) {
      const { right, up, forward } = viewAxes({ ...camera, eye, target: { x: 0, y: 0.35, z: 0 } });
      for (const axis of [right, up, forward]) expect(dot(axis, axis)).toBeCloseTo(1, 9);
      expect(dot(right, up)).toBeCloseTo(0, 9);
      expect(dot(right, forward)).toBeCloseTo(0, 9);
      expect(dot(up, forward)).toBeCloseTo(0, 9);
    }
  });
});

describe("framed", () => {
  test("leaves wide pictures alone and stands back for narrow ones", () => {
    expect(framed(camera, 16 / 9)).toEqual(camera);
    expect(distanceOf(framed(camera, 2 / 3))).toBeCloseTo(2 * distanceOf(camera), 9);
    expect(framed(camera, Number.NaN)).toEqual(camera);
  });
});

describe("keyMove", () => {
  test("turns with arrows, moves with shift and arrows, zooms with plus and minus", () => {
    expect(keyMove(camera, "ArrowLeft", false)?.target).toEqual(camera.target);
    expect(keyMove(camera, "ArrowLeft", true)?.target).not.toEqual(camera.target);
    expect(distanceOf(keyMove(camera, "+", false)!)).toBeLessThan(distanceOf(camera));
    expect(keyMove(camera, "x", false)).toBeUndefined();
  });
});

describe("a ray through the picture", () => {
  test("is the line of sight in its middle", () => {
    const { origin, direction } = rayThrough(camera, 16 / 9, 0.5, 0.5);
    expect(origin).toEqual(camera.eye);
    expect(dot(direction, viewAxes(camera).forward)).toBeCloseTo(1, 12);
  });

  test("leans by half of the field of view at the upper edge, and by the aspect more at the side", () => {
    const { forward, up, right } = viewAxes(camera);
    const top = rayThrough(camera, 2, 0.5, 0).direction;
    expect((Math.acos(dot(top, forward)) * 180) / Math.PI).toBeCloseTo(22.5, 9);
    expect(dot(top, up)).toBeGreaterThan(0);
    const side = rayThrough(camera, 2, 1, 0.5).direction;
    expect(dot(side, right) / dot(side, forward)).toBeCloseTo(2 * Math.tan(Math.PI / 8), 9);
  });
});
