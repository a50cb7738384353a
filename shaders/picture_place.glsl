// Needs frame_uniforms.glsl. The picture of the scene without the liquid, and where it shows what.
layout(binding = 1) uniform sampler2D scene;

vec2 placeInPicture(vec2 slope) { return 0.5 + 0.5 * slope / frame.pictureSlopes.xy; }
