// What stands in the scene as inverse eye depth: floor and bodies. Needs frame_uniforms.glsl.
layout(binding = 7) uniform sampler2D sceneDepth;

// Of the floor alone; 0 where the line of sight does not meet it.
float floorInverseDepth(vec2 W) {
  float fall = toWorldDirection(vec3(W, 1.0)).y / (frame.floorAndHaze.x - frame.eye.y);
  return frame.floorAndHaze.z > 0.5 ? max(fall, 0.0) : 0.0;
}

float sceneDepthAt(vec2 W) { return texture(sceneDepth, 0.5 + 0.5 * W / frame.pictureSlopes.xy).r; }

// Of a body; 0 where floor or nothing is seen.
float bodyDepthAt(vec2 W) {
  float q = sceneDepthAt(W);
  // The floor of that very pixel, whose middle may be off the line of sight.
  vec2 size = vec2(textureSize(sceneDepth, 0));
  vec2 pixel = (floor((0.5 + 0.5 * W / frame.pictureSlopes.xy) * size) + 0.5) / size;
  return q > floorInverseDepth((2.0 * pixel - 1.0) * frame.pictureSlopes.xy) * 1.0001 ? q : 0.0;
}
