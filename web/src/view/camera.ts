// The viewer's camera: a pinhole that orbits its target. Everything here is pure; lengths are metres, angles radians
// where the name does not say degrees.

export interface Vec3 {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export interface Camera {
  readonly eye: Vec3;
  readonly target: Vec3;
  readonly up: Vec3;
  readonly verticalFovDegrees: number;
}

/** Nearest and farthest that zooming takes the eye to its target, m. */
export const kMinDistance = 1e-3;
export const kMaxDistance = 5e4;
/** The server takes coordinates up to 1e5 m; target and distance together stay below it. */
const kMaxTarget = 4e4;
/** How near the line of sight comes to the up axis: beyond it the picture would flip over. */
const kPoleMargin = Math.PI / 180;

const add = (a: Vec3, b: Vec3): Vec3 => ({ x: a.x + b.x, y: a.y + b.y, z: a.z + b.z });
const sub = (a: Vec3, b: Vec3): Vec3 => ({ x: a.x - b.x, y: a.y - b.y, z: a.z - b.z });
const scale = (a: Vec3, s: number): Vec3 => ({ x: a.x * s, y: a.y * s, z: a.z * s });
const dot = (a: Vec3, b: Vec3): number => a.x * b.x + a.y * b.y + a.z * b.z;
const cross = (a: Vec3, b: Vec3): Vec3 => ({
  x: a.y * b.z - a.z * b.y,
  y: a.z * b.x - a.x * b.z,
  z: a.x * b.y - a.y * b.x,
});
const length = (a: Vec3): number => Math.hypot(a.x, a.y, a.z);
const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

/** Unit vector along `a`, or `otherwise` where `a` has no direction. */
function direction(a: Vec3, otherwise: Vec3): Vec3 {
  const size = length(a);
  return size > 0 && Number.isFinite(size) ? scale(a, 1 / size) : otherwise;
}

/** `v` turned about the unit vector `axis` by `angle` (Rodrigues). */
function turned(v: Vec3, axis: Vec3, angle: number): Vec3 {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return add(add(scale(v, c), scale(cross(axis, v), s)), scale(axis, dot(axis, v) * (1 - c)));
}

/** The camera's axes in the world: orthonormal, as the server builds them, also where `up` lies along the view. */
export function viewAxes(camera: Camera): { right: Vec3; up: Vec3; forward: Vec3 } {
  const forward = direction(sub(camera.target, camera.eye), { x: 0, y: 0, z: -1 });
  const worldUp = direction(camera.up, { x: 0, y: 1, z: 0 });
  let right = cross(forward, worldUp);
  if (length(right) < 1e-5) {
    right = cross(forward, Math.abs(forward.y) < 0.9 ? { x: 0, y: 1, z: 0 } : { x: 0, y: 0, z: -1 });
  }
  right = direction(right, { x: 1, y: 0, z: 0 });
  return { right, up: cross(right, forward), forward };
}

export function distanceOf(camera: Camera): number {
  return length(sub(camera.eye, camera.target));
}

/**
 * Turns the eye about the target: `yaw` about the up axis, then `pitch` about the camera's right axis. Positive yaw
 * moves the eye to the right, positive pitch moves it up; it stops just short of the poles.
 */
export function orbit(camera: Camera, yaw: number, pitch: number): Camera {
  const { right, forward } = viewAxes(camera);
  const axis = direction(camera.up, { x: 0, y: 1, z: 0 });
  const elevation = Math.asin(clamp(-dot(forward, axis), -1, 1));
  const limit = Math.PI / 2 - kPoleMargin;
  // A camera that a scene placed beyond the margin may stay there, but turns only back towards the horizon.
  const low = Math.min(-limit, elevation);
  const high = Math.max(limit, elevation);
  const lifted = clamp(elevation + pitch, low, high) - elevation;
  const offset = scale(forward, -distanceOf(camera));
  return { ...camera, eye: add(camera.target, turned(turned(offset, right, -lifted), axis, yaw)) };
}

/** Moves eye and target together in the plane of the picture, by fractions of its height at the target's depth. */
export function pan(camera: Camera, rightwards: number, upwards: number): Camera {
  const { right, up } = viewAxes(camera);
  const height = 2 * distanceOf(camera) * Math.tan((camera.verticalFovDegrees * Math.PI) / 360);
  const wanted = add(camera.target, add(scale(right, rightwards * height), scale(up, upwards * height)));
  const target = {
    x: clamp(wanted.x, -kMaxTarget, kMaxTarget),
    y: clamp(wanted.y, -kMaxTarget, kMaxTarget),
    z: clamp(wanted.z, -kMaxTarget, kMaxTarget),
  };
  return { ...camera, eye: add(camera.eye, sub(target, camera.target)), target };
}

/** Moves the eye along its line of sight; `factor` multiplies its distance to the target. */
export function zoom(camera: Camera, factor: number): Camera {
  const distance = clamp(distanceOf(camera) * factor, kMinDistance, kMaxDistance);
  return { ...camera, eye: add(camera.target, scale(viewAxes(camera).forward, -distance)) };
}

/** Scenes are framed for pictures that are at least this much wider than high. */
const kFramedAspect = 4 / 3;

/**
 * The camera a scene starts with, for a picture of this width over height. Where the picture is narrower than the scene
 * was framed for, the eye stands back until all of the width is in it.
 */
export function framed(camera: Camera, aspect: number): Camera {
  return aspect > 0 && aspect < kFramedAspect ? zoom(camera, kFramedAspect / aspect) : camera;
}

/** A ray from the eye; `direction` is of length 1. */
export interface Ray {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

/** The ray through a point of the picture: `x` from its left and `y` from its top, as shares of its size. */
export function rayThrough(camera: Camera, aspect: number, x: number, y: number): Ray {
  const { right, up, forward } = viewAxes(camera);
  const half = Math.tan((camera.verticalFovDegrees * Math.PI) / 360);
  const across = add(scale(right, (2 * x - 1) * half * aspect), scale(up, (1 - 2 * y) * half));
  return { origin: camera.eye, direction: direction(add(forward, across), forward) };
}
