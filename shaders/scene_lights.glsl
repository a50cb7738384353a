// Lights on bodies and floor. Mirrors `SceneLights` in server/render/scene_lights.h; a test compares them.
layout(std140, binding = 4) uniform SceneLights {
  vec4 sunlight;       // radiance of a white surface that faces the sun; strength of shadows
  vec4 toShadowU;      // from the scene to the bodies' shadow map: u = dot(toShadowU, (x, 1)),
  vec4 toShadowV;      // v
  vec4 toShadowDepth;  // and depth, 0 towards the sun
  vec4 counts;         // lamps; contacts; a texel of the shadow map, m; 1 where bodies cast shadows, else 0
  vec4 lampPlace[8];   // m
  vec4 lampLight[8];   // radiance of a white surface that faces it from 1 m away
  vec4 contact[8];     // centre and radius of what hides sky from the floor
  vec4 body[8];        // centre and radius of balls around all bodies; of radius 0 after the last
} lights;
