// A scene as a server sends it: complete, with every default filled in.

import { create } from "@bufbuild/protobuf";

import { type Scene, SceneSchema } from "../src/gen/sluice/v1/scene_pb";

export function damBreak(): Scene {
  return create(SceneSchema, {
    title: "Dam break",
    seed: 1n,
    source: {
      case: "simulation",
      value: {
        particleSpacing: 0.04,
        gravity: { x: 0, y: -9.81, z: 0 },
        boundary: { case: "container", value: { min: { x: -1, y: 0, z: -1 }, max: { x: 1, y: 1, z: 1 } } },
        fluids: [
          {
            viscosity: 0.02,
            blocks: [{ firstParticle: { x: -0.9, y: 0.1, z: -0.9 }, countX: 20 }, { firstParticle: { x: 0.2, y: 0.1, z: 0 } }],
          },
        ],
        pressureSolver: { case: "dfsph", value: {} },
        kernel: { case: "cubicSpline", value: {} },
        timeStep: {},
      },
    },
    look: {
      splats: {},
      smoothing: { time: 2, method: { case: "curvatureFlow", value: {} } },
      thickness: { divisor: 4 },
      liquid: { absorption: { x: 1.9, y: 0.55, z: 0.35 }, colour: { x: 0.1, y: 0.32, z: 0.45 } },
    },
    background: { environment: { case: "sky", value: { zenith: { x: 0.1, y: 0.24, z: 0.56 } } } },
    lighting: { sun: { direction: { x: 0.45, y: 0.75, z: 0.35 } } },
    camera: { eye: { x: 2, y: 1.5, z: 3 }, target: {}, up: { x: 0, y: 1, z: 0 } },
    playback: {},
  });
}
